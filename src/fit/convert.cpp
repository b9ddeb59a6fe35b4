#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <set>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "codec/limits.hpp"
#include "codec/utf8.hpp"
#include "fit/normal_error.hpp"
#include "fit/quantise.hpp"
#include "fit/refine.hpp"
#include "fit/shapes.hpp"
#include "fit/source_data.hpp"
#include "io/text.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

double diagonal(const PolygonMesh& mesh) {
  Box box;
  for (const Index v : mesh.polygons.corners) box.include(mesh.positions[v]);
  return box.isEmpty() ? diagonal(std::span(mesh.positions)) : norm(box.size());
}

Result<void> checkTolerance(double tolerance, double diagonal) {
  // Of the diagonal: what single precision rounds off at its end.
  constexpr double kLeast = 0x1p-25;
  if (tolerance > diagonal)
    return fail(fmt::format(
        "a tolerance of {:.3g} is larger than the mesh, which is {:.3g} across; ask for a finer "
        "one",
        tolerance, diagonal));
  if (tolerance >= kLeast * diagonal) return {};
  return fail(fmt::format(
      "a tolerance of {:.3g} is finer than a file's numbers, {:.3g} for a mesh of this size; "
      "allow a larger one",
      tolerance, kLeast * diagonal));
}

namespace {

constexpr int kMostRounds = 60;
// The fit's share of the tolerance where the rest is left to packing.
constexpr double kFitShare = 0.9;
// What packing does to normals is more than a limit on the fit's could mend.
constexpr double kNormalShare = 1.25;
// Predicted slopes overshoot where an edge is this many times as long as the next along its line.
constexpr double kUneven = 3;
// At the default tolerance of 0.02 % of the diagonal normals may be this far off, in degrees.
constexpr double kNormalLimitAtDefault = 2.8;

// What packing aims at, of the limit.
constexpr double kAngleShare = 0.2;
// The limit that leads to normals within a tolerance, root mean square.
constexpr double kLimitForTolerance = 2.5;

/// Those to be tried in turn. A tighter one brings normals nearer, but now and then its fit is one
/// to which packing does more harm; 180 is none.
std::vector<double> normalLimits(const ConvertOptions& options, double tolerance, double size) {
  if (options.normalLimit > 0) return {options.normalLimit};
  const double usual = std::clamp(kNormalLimitAtDefault * tolerance / (0.0002 * size), 2.0, 60.0);
  const double tight = kLimitForTolerance * options.normalTolerance;
  if (!(options.normalTolerance > 0)) return {usual};
  return tight < usual ? std::vector{tight, usual, 180.0} : std::vector{usual, 180.0};
}

// The stored vectors as they will be after the file: neutral and differences rounded each to single
// precision. What is verified is what will be read back.
Solution asStored(const Solution& solution) {
  const auto rounded = [](const auto& x) {
    return x.template cast<float>().template cast<double>();
  };
  Solution stored(solution.rows(), solution.cols());
  parallelRanges(solution.rows(), [&](Eigen::Index first, Eigen::Index end) {
    for (Eigen::Index v = first; v < end; ++v) {
      const auto fitted = solution.row(v);
      auto row = stored.row(v);
      row.leftCols<3>() = rounded(fitted.leftCols<3>());
      for (Eigen::Index k = 3; k < solution.cols(); k += 3)
        row.segment<3>(k) =
            row.leftCols<3>() + rounded(fitted.segment<3>(k) - fitted.leftCols<3>());
    }
  });
  return stored;
}

/// Files tell targets apart by their names, which are UTF-8.
Result<void> checkNames(const std::vector<MeshTarget>& targets) {
  std::set<std::string_view> names;
  for (const MeshTarget& target : targets) {
    if (target.name.empty()) return fail("a target has no name; name it");
    if (!codec::isUtf8(target.name))
      return fail("the name of the target " + io::inQuotes(target.name) +
                  " has control characters or is not UTF-8; rename it");
    if (target.name.size() > codec::kLongestName)
      return fail("the name of a target, ", io::inQuotes(target.name), ", is longer than ",
                  codec::kLongestName, " bytes; shorten it");
    if (!names.insert(target.name).second)
      return fail("two targets are named " + io::inQuotes(target.name) + "; rename one of them");
  }
  return {};
}

/// Files hold what targets add to the neutral in single precision.
Result<void> checkDifferences(const MeshRig& source) {
  for (const MeshTarget& target : source.targets)
    for (std::size_t v = 0; v < target.positions.size(); ++v) {
      if (!io::isUsable(target.positions[v] - source.neutral.positions[v]))
        return fail("vertex ", v + 1, " of the target ", io::inQuotes(target.name),
                    " is further from the neutral's than a file can tell; scale the meshes down");
    }
  return {};
}

class Converter {
 public:
  Converter(const MeshRig& source, const ConvertOptions& options)
      : source_(source), options_(options) {}

  Result<Conversion> run() {
    if (source_.neutral.positions.empty())
      return fail("the neutral has no vertices; there is no surface to fit");
    if (auto ok = checkNames(source_.targets); !ok) return std::unexpected(ok.error());
    if (auto ok = checkDifferences(source_); !ok) return std::unexpected(ok.error());
    if (options_.textureBits < 8 || options_.textureBits > 16)
      return fail("packed texture coordinates have 8 to 16 bits, not ", options_.textureBits);
    const double size = diagonal(source_.neutral);
    if (!(size > 0))
      return fail(
          "all vertices of the neutral stand at one place, as far as numbers tell; there is no "
          "surface to fit");
    const double tolerance = options_.tolerance > 0 ? options_.tolerance : 0.0002 * size;
    if (auto ok = checkTolerance(tolerance, size); !ok) return std::unexpected(ok.error());
    auto mesh = makeGridMesh(source_);
    if (!mesh) return std::unexpected(mesh.error());
    const bool limitsNormals = options_.pack && options_.normalTolerance > 0;
    std::optional<Error> failure;
    for (const double limit : normalLimits(options_, tolerance, size)) {
      auto conversion = convertWithin(*mesh, tolerance, limit);
      if (!conversion) {
        if (cancelled() || !limitsNormals) return conversion;
        failure = conversion.error();
      } else if (!limitsNormals || normalRms_ <= options_.normalTolerance) {
        report("done", 1);
        return conversion;
      }
    }
    if (failure && !std::isfinite(nearestNormals_)) return std::unexpected(*failure);
    return fail(fmt::format(
        "normals came no nearer to the mesh's than {:.4g} degrees at this tolerance; allow "
        "more, or try a smaller tolerance or another limit on normals",
        nearestNormals_));
  }

 private:
  // Sets normalRms_ where there is a tolerance for normals.
  Result<Conversion> convertWithin(const GridMesh& mesh, double tolerance, double angle) {
    limits_ = {(options_.pack ? kFitShare : 1) * tolerance,
               std::min(180.0, (options_.pack ? kNormalShare : 1) * angle), angle < 180};

    SourceData data = gatherSource(source_, mesh, tolerance);
    Layout layout(mesh, source_.neutral.positions, options_.pack);
    for (Index v = 0; v < mesh.vertexCount(); ++v)
      data.uneven.push_back(layout.isUneven(v, source_.neutral.positions, kUneven));
    if (!limits_.smooth) data.slopeWeight = 0.1;
    auto solution = fit(layout, data);
    if (!solution) return std::unexpected(solution.error());
    const auto vectors = static_cast<std::size_t>(solution->rows()) * data.poses;
    if (vectors > codec::kMostVectors)
      return fail("the surface takes ", solution->rows(), " vectors in each of ", data.poses,
                  " shapes, together more than the ", codec::kMostVectors,
                  " of a file; give fewer targets, or allow a larger tolerance");
    Conversion conversion{assemble(mesh, *solution, data), mesh.warnings};
    conversion.rig.tolerance = tolerance;
    if (options_.pack) {
      report("packing", 0.95);
      if (auto ok = pack(conversion.rig, tolerance, kAngleShare * angle); !ok)
        return std::unexpected(ok.error());
    }
    return conversion;
  }

  bool cancelled() const { return options_.cancel && options_.cancel->load(); }
  void report(std::string_view what, double done) {
    done_ = std::max(done_, done);
    if (options_.progress) options_.progress(what, done_);
  }

  Result<void> packOnce(Rig& rig, double tolerance, double angle) const {
    const auto proceed = [&](double) { return !cancelled(); };
    const Result<void> ok = quantise(rig, source_, tolerance, angle, proceed);
    rig.packing.textureBits = options_.textureBits;
    return ok;
  }

  // Aims at smaller angles until they are as small as they must be, or no try is left.
  Result<void> pack(Rig& rig, double tolerance, double angle) {
    if (!(options_.normalTolerance > 0)) return packOnce(rig, tolerance, angle);
    const Rig fitted = rig;
    constexpr int kTries = 8;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      rig = fitted;
      if (auto ok = packOnce(rig, tolerance, angle); !ok) {
        if (attempt > 0 && !cancelled()) break;  // it was the angle that was too small
        return ok;
      }
      normalRms_ = normalRms(rig, source_);
      nearestNormals_ = std::min(nearestNormals_, normalRms_);
      if (normalRms_ <= options_.normalTolerance) break;
      angle *= std::clamp(0.8 * options_.normalTolerance / normalRms_, 0.2, 0.8);
    }
    return {};
  }

  // Solve, measure, refine, until every vertex is within the limits. The limit on distance is a
  // promise, the one on normals an aim: once refinement stalls, only the promise counts.
  Result<Solution> fit(Layout& layout, SourceData& data) {
    ExtraJets extra(data.uneven.size(), 0);
    for (std::size_t v = 0; v < extra.size(); ++v)
      if (data.uneven[v]) {
        extra[v] = kSlopes;
        const Index image = layout.image(static_cast<Index>(v));
        if (image >= 0) extra[image] = kSlopes;
      }
    double nearest = std::numeric_limits<double>::infinity();
    int smoothing = 0;  // rounds since the promise holds, spent on normals
    for (int round = 0; round < kMostRounds; ++round) {
      if (cancelled()) return fail("the conversion was interrupted");
      auto draft = makeDraft(layout, extra);
      if (!draft) return std::unexpected(draft.error());
      auto solution = solve(layout, *draft, data);
      if (!solution) return std::unexpected(solution.error());
      *solution = asStored(*solution);
      const DraftErrors errors = measureDraft(layout, *draft, data, *solution);
      const bool within = errors.largestDistance <= limits_.distance;
      nearest = std::min(nearest, errors.largestDistance);
      report("fitting",
             within
                 ? 0.9
                 : 0.9 * std::min(1.0, std::pow(limits_.distance / errors.largestDistance, 0.5)));
      const Index changed = refine(layout, *draft, data, errors, limits_, extra);
      if (within && changed == 0) {
        draft_ = std::move(*draft);
        return reshape(layout, data, *solution, errors);
      }
      if (changed == 0) break;
      if (within && ++smoothing >= 8) limits_.angle = 180;
    }
    return fail(fmt::format(
        "a tolerance of {:.3g} is out of reach: the surface comes no nearer to all vertices than "
        "{:.3g}; allow a larger one",
        data.tolerance, nearest));
  }

  // Gives ribbons shape parameters that bring the surface nearer, and keeps them if the fit that
  // follows is better and still within the limits.
  Result<Solution> reshape(const Layout& layout, const SourceData& data, Solution& solution,
                           const DraftErrors& errors) {
    if (!options_.chooseShapes) return std::move(solution);
    report("shape parameters", 0.92);
    Wireframe wireframe = draft_.surface.wireframe();
    if (chooseShapes(layout, draft_, data, solution, wireframe.ribbons) == 0)
      return std::move(solution);
    auto surface = Surface::make(std::move(wireframe));
    if (!surface) return std::move(solution);
    Draft reshaped{draft_.patches, std::move(*surface)};
    auto again = solve(layout, reshaped, data);
    if (!again) return std::move(solution);
    *again = asStored(*again);
    const DraftErrors now = measureDraft(layout, reshaped, data, *again);
    if (now.largestDistance > limits_.distance || now.weightedSquares >= errors.weightedSquares)
      return std::move(solution);
    draft_ = std::move(reshaped);
    return again;
  }

  Rig assemble(const GridMesh& mesh, const Solution& solution, const SourceData& data) {
    Rig rig;
    rig.surface = std::move(draft_.surface);
    const auto row = [&](Eigen::Index v, Index pose) {
      return SourceData::at(solution, static_cast<Index>(v), pose);
    };
    for (Eigen::Index v = 0; v < solution.rows(); ++v) rig.neutral.push_back(row(v, 0));
    for (Index k = 1; k < data.poses; ++k) {
      Target target{source_.targets[k - 1].name, {}, {}};
      for (Eigen::Index v = 0; v < solution.rows(); ++v)
        target.difference.push_back(row(v, k) - row(v, 0));
      rig.targets.push_back(std::move(target));
    }
    mapSource(rig, mesh);
    return rig;
  }

  void mapSource(Rig& rig, const GridMesh& mesh) const {
    const Tessellation grid(rig.surface, 1);
    std::vector<Index> gridOfPoint(mesh.pointCount(), -1);
    for (Index p = 0; p < rig.surface.patchCount(); ++p) {
      const GridPatch& patch = draft_.patches[p];
      for (Index j = 0; j <= patch.n; ++j)
        for (Index i = 0; i <= patch.m; ++i)
          gridOfPoint[mesh.point[patch.vertex(i, j)]] = grid.vertex(p, i, j);
      for (std::size_t q = 0; q < patch.quads.size(); ++q)
        for (int k = 0; k < 4; ++k)
          rig.source.quadCorners.push_back(
              mesh.quadCorners[patch.quads[q]][((patch.bottoms[q] & 3) + k) % 4]);
    }
    const auto& positions = source_.neutral.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Index point = mesh.pointOfSource[v];
      if (point >= 0) {
        rig.source.gridVertex.push_back(gridOfPoint[point]);
        continue;
      }
      rig.source.gridVertex.push_back(-1 - static_cast<Index>(rig.source.loose.size()));
      rig.source.loose.push_back(positions[v]);
      for (std::size_t k = 0; k < rig.targets.size(); ++k)
        rig.targets[k].looseDifference.push_back(source_.targets[k].positions[v] - positions[v]);
    }
    rig.source.polygons = source_.neutral.polygons;
  }

  const MeshRig& source_;
  const ConvertOptions& options_;
  RefineLimits limits_{};
  double normalRms_ = 0, nearestNormals_ = std::numeric_limits<double>::infinity();
  Draft draft_;
  double done_ = 0;
};

}  // namespace

Result<Conversion> convert(const MeshRig& source, const ConvertOptions& options) {
  return Converter(source, options).run();
}

}  // namespace sweepface
