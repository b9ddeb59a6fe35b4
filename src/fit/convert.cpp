#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "codec/limits.hpp"
#include "fit/assemble.hpp"
#include "fit/check_source.hpp"
#include "fit/defaults.hpp"
#include "fit/doubts.hpp"
#include "fit/quantise.hpp"

namespace sweepface {

namespace {

// Vertices that rounding left this near each other become one: shares of diagonal and tolerance.
constexpr double kRounding = 1e-6, kRoundingShare = 1.0 / 64;
// The fit's share of the tolerance where the rest is left to packing.
constexpr double kFitShare = 0.9;
// Solving leaves traces of an expression everywhere, which move nothing visibly but would make
// every expression as large as the neutral: below this share of the tolerance they are dropped.
// Packing rounds them away by itself.
constexpr double kTrace = 0.001;
// Factor on the fit's limit on normals before packing, which changes normals by more than a tighter
// limit could make up for.
constexpr double kNormalShare = 1.25;
// Predicted slopes overshoot where an edge is this many times as long as the next along its line.
constexpr double kUneven = 3;
// The next angle that packing aims at, relative to the last one, if nothing guides it.
constexpr double kSmaller = 0.35;
// If the error of normals stays above this share of the last one, packing can do no more for them.
constexpr double kGain = 0.97;
// If packing aims at less than half of the usual angle, steps are finer in proportion, down to this
// share: steps too large for the angle make normals worse and the search long.
constexpr double kFinestSteps = 1.0 / 64;
// This times the tolerance for normals, which is an RMS, is the limit that most likely meets it.
constexpr double kLimitForTolerance = 2.5;
// The tightest limit that is tried, in degrees; nearly every edge of the mesh is a curve by then.
constexpr double kTightest = 0.3;

/// An attempt to meet the tolerance for normals.
struct NormalTry {
  double limit = 0;       ///< on the fit's normals; 180: none
  bool isGuided = false;  ///< whether the angle packing aims at follows the tolerance for normals
};

bool limitsNormals(const ConvertOptions& options) {
  return options.pack && options.normalTolerance > 0;
}

/// The attempts in turn, first those that most likely meet the tolerance for normals. A tighter
/// limit brings normals nearer, but now and then packing does more harm to its fit. If none of
/// these succeeds, limits follow that do not depend on the tolerance for normals, so that the
/// figure in a refusal can be reached by asking for it.
std::vector<NormalTry> normalTries(const ConvertOptions& options, double usual) {
  const double limit = options.normalLimit > 0 ? options.normalLimit : usual;
  if (!limitsNormals(options)) return {{limit, false}, {180, false}};
  if (options.normalLimit > 0) return {{limit, true}, {limit, false}};
  std::vector<NormalTry> tries{{usual, true}, {180, true}};
  const double tight = std::max(kLimitForTolerance * options.normalTolerance, kTightest);
  if (tight < usual) tries.insert(tries.begin(), {tight, true});
  for (double next = usual; next >= kTightest; next /= 2) tries.push_back({next, false});
  return tries;
}

constexpr const char* kWithoutNormals =
    "The tolerance was out of reach while normals were to be near the mesh's; so they were left to "
    "themselves, as with --normal-limit 180.";

/// Rounded up to four digits, so that what is written is never too small.
double roundedUp(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 3);
  return std::ceil(x / unit * (1 + 1e-12)) * unit;
}

class Converter {
 public:
  Converter(const MeshRig& source, const ConvertOptions& options)
      : source_(source), options_(options), progress_(options) {}

  Result<Conversion> run() {
    if (auto ok = checkSource(source_); !ok) return std::unexpected(ok.error());
    if (auto ok = checkOptions(); !ok) return std::unexpected(ok.error());
    const double size = diagonal(source_.neutral);
    tolerance_ = options_.tolerance > 0 ? options_.tolerance : kDefaultTolerance * size;
    if (auto ok = checkTolerance(tolerance_, size); !ok) return std::unexpected(ok.error());
    if (auto ok = checkPrecision(source_, tolerance_); !ok) return std::unexpected(ok.error());
    auto mesh = makeGridMesh(source_, std::min(kRounding * size, kRoundingShare * tolerance_),
                             std::min(kDefaultTolerance * size, tolerance_));
    if (!mesh) return std::unexpected(mesh.error());
    aim_ = tolerance_ - mesh->rounding;
    std::ranges::move(doubtsAbout(source_, tolerance_), std::back_inserter(mesh->warnings));
    usualLimit_ = usualNormalLimit(tolerance_, size);
    const bool isLimited = limitsNormals(options_);
    std::optional<Error> failure;
    for (const NormalTry& next : normalTries(options_, usualLimit_)) {
      auto conversion = convertWithin(*mesh, next);
      if (!conversion) {
        if (progress_.cancelled() || !(isLimited || reach_.isBeyond)) return conversion;
        failure = conversion.error();
      } else if (!isLimited || normalRms_ <= options_.normalTolerance) {
        progress_.end();
        if (failure && !isLimited) conversion->warnings.push_back(kWithoutNormals);
        return conversion;
      } else if (!next.isGuided) {
        nearest_ = std::min(nearest_, normalRms_);
      }
    }
    if (failure && !std::isfinite(nearest_)) return std::unexpected(*failure);
    return fail(fmt::format(
        "{} {:.4g} degrees at this tolerance; allow more, or try a smaller tolerance or another "
        "limit on normals",
        kNormalsOutOfReach, roundedUp(nearest_)));
  }

 private:
  Result<void> checkOptions() const {
    for (const auto& [value, what] : {std::pair(options_.tolerance, "the tolerance"),
                                      {options_.normalLimit, "the limit on normals"},
                                      {options_.normalTolerance, "the tolerance for normals"}})
      if (auto ok = checkFromZero(value, what); !ok) return ok;
    return checkTextureBits(options_.textureBits);
  }

  // Sets normalRms_ if there is a tolerance for normals.
  Result<Conversion> convertWithin(const GridMesh& mesh, const NormalTry& normals) {
    auto found = fits_.find(normals.limit);
    if (found == fits_.end())
      found = fits_.emplace(normals.limit, fitWithin(mesh, normals.limit)).first;
    if (!found->second || !options_.pack) return found->second;
    progress_.reportPacking("packing", 0);
    Conversion conversion = *found->second;
    if (auto ok = pack(conversion.rig, found->second->rig, normals); !ok)
      return std::unexpected(ok.error());
    return conversion;
  }

  Result<Conversion> fitWithin(const GridMesh& mesh, double angle) {
    const RefineLimits limits{.distance = (options_.pack ? kFitShare : 1) * aim_,
                              .angle = std::min(180.0, (options_.pack ? kNormalShare : 1) * angle),
                              .smooth = angle < 180,
                              .trace = options_.pack ? 0 : kTrace * aim_};
    SourceData data = gatherSource(source_, mesh, tolerance_);
    Layout layout(mesh, source_.neutral.positions, options_.pack);
    for (Index v = 0; v < mesh.vertexCount(); ++v)
      data.uneven.push_back(layout.isUneven(v, source_.neutral.positions, kUneven));
    if (!limits.smooth) data.slopeWeight = 0.1;
    auto fitted = fitSurface(layout, data, limits, options_.chooseShapes, progress_, reach_);
    if (!fitted) return std::unexpected(fitted.error());
    const auto stored = fitted->solution.rows();
    if (static_cast<std::uint64_t>(stored) * data.poses > codec::kMostVectors)
      return fail("the surface takes ", stored, " vectors in each of ", data.poses,
                  " shapes, together more than the ", codec::kMostVectors,
                  " of a file; give fewer targets, or allow a larger tolerance");
    Conversion conversion{assemble(source_, mesh, std::move(*fitted)), mesh.warnings};
    conversion.rig.tolerance = tolerance_;
    return conversion;
  }

  // Aims at smaller and smaller angles until normals are within their tolerance or that no longer
  // helps. The rig is that of the last try, normalRms_ the least of all; packing hardly ever makes
  // it less than the fit's, so a fit whose own is too large is not packed.
  Result<void> pack(Rig& rig, const Rig& fitted, const NormalTry& normals) {
    double angle = kAngleShare * normals.limit;
    if (!(options_.normalTolerance > 0)) return packOnce(rig, angle);
    normalRms_ = std::numeric_limits<double>::infinity();
    if (normalErrors(fitted, source_).rms >
        (normals.isGuided ? options_.normalTolerance : nearest_))
      return {};
    constexpr int kTries = 8;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      rig = fitted;
      if (auto ok = packOnce(rig, angle); !ok) {
        if (attempt > 0 && !progress_.cancelled()) break;  // only the angle was too small
        return ok;
      }
      const double rms = normalErrors(rig, source_).rms,
                   before = std::exchange(normalRms_, std::min(normalRms_, rms));
      if (rms <= options_.normalTolerance || rms > kGain * before) break;
      progress_.reportPacking(
          fmt::format("packing, normals {:.3g} of {:.3g} degrees", rms, options_.normalTolerance),
          0);
      angle *=
          normals.isGuided ? std::clamp(0.8 * options_.normalTolerance / rms, 0.2, 0.8) : kSmaller;
    }
    return {};
  }

  Result<void> packOnce(Rig& rig, double angle) {
    const auto proceed = [&](double done) {
      progress_.reportPacking("packing", done);
      return !progress_.cancelled();
    };
    const double stepShare = std::clamp(2 * angle / (kAngleShare * usualLimit_), kFinestSteps, 1.0);
    const Result<void> ok =
        quantise(rig, source_, goalsOf(rig, source_), {aim_, angle, stepShare}, proceed);
    rig.packing.textureBits = options_.textureBits;
    return ok;
  }

  const MeshRig& source_;
  const ConvertOptions& options_;
  ConversionProgress progress_;
  double tolerance_ = 0, usualLimit_ = 0;
  double aim_ = 0;                             // the tolerance less the rounding of merged vertices
  std::map<double, Result<Conversion>> fits_;  // by their limits on normals
  FitReach reach_;
  double normalRms_ = 0;
  double nearest_ = std::numeric_limits<double>::infinity();  // of the attempts not guided
};

}  // namespace

Result<Conversion> convert(const MeshRig& source, const ConvertOptions& options) {
  return Converter(source, options).run();
}

}  // namespace sweepface
