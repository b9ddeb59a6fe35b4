#include "fit/fit_surface.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "fit/shapes.hpp"
#include "fit/tips.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

constexpr int kMostRounds = 60;
// At most this many of them are for the sake of normals alone.
constexpr int kMostForNormals = 8;

// The stored vectors as they will be read back from the file: neutral and differences each rounded
// to single precision, without traces. So what is verified is what will be read.
Solution asStored(const Solution& solution, double trace) {
  const auto rounded = [](const Vec3& v) {
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return Vec3{single(v.x), single(v.y), single(v.z)};
  };
  const auto poses = static_cast<Index>(solution.cols() / 3);
  Solution stored(solution.rows(), solution.cols());
  parallelRanges(solution.rows(), [&](Eigen::Index first, Eigen::Index end) {
    for (auto v = static_cast<Index>(first); v < end; ++v) {
      const Vec3 fitted = SourceData::at(solution, v, 0), neutral = rounded(fitted);
      for (Index pose = 0; pose < poses; ++pose) {
        const Vec3 moved = rounded(SourceData::at(solution, v, pose) - fitted);
        const Vec3 there = norm(moved) < trace ? neutral : neutral + moved;
        stored.row(v).segment<3>(3 * pose) << there.x, there.y, there.z;
      }
    }
  });
  return stored;
}

class SurfaceFitter {
 public:
  SurfaceFitter(Layout& layout, SourceData& data, const RefineLimits& limits, bool choosesShapes,
                ConversionProgress& progress)
      : layout_(layout),
        data_(data),
        limits_(limits),
        choosesShapes_(choosesShapes),
        progress_(progress) {}

  // Solve, measure, refine.
  Result<Fitted> run(FitReach& reach) {
    reach.isBeyond = false;
    ExtraJets extra = slopesWhereUneven();
    int smoothing = 0;  // rounds in which the promise held
    for (int round = 0; round < kMostRounds; ++round) {
      if (progress_.cancelled()) return fail("the conversion was interrupted");
      auto draft = makeDraft(layout_, extra);
      if (!draft) return std::unexpected(draft.error());
      auto fitted = solved(std::move(*draft));
      if (!fitted) return fitted;
      const DraftErrors errors = measured(*fitted);
      const bool within = errors.largestDistance <= limits_.distance;
      reach.nearest = std::min(reach.nearest, errors.largestDistance);
      const double share = within ? 1 : std::sqrt(limits_.distance / errors.largestDistance);
      progress_.reportFit("fitting", 0.9 * share);
      const Index changed = refine(layout_, fitted->draft, data_, errors, limits_, extra);
      if (changed == 0 && within) return reshaped(std::move(*fitted), errors);
      if (changed == 0) break;
      if (within && ++smoothing >= kMostForNormals) limits_.angle = 180;
    }
    reach.isBeyond = true;
    return fail(fmt::format(
        "a tolerance of {:.3g} is out of reach: the surface comes no nearer to all vertices than "
        "{:.3g}; allow a larger one",
        data_.tolerance, reach.nearest));
  }

 private:
  ExtraJets slopesWhereUneven() const {
    ExtraJets extra(data_.uneven.size(), 0);
    for (Index v = 0; v < static_cast<Index>(extra.size()); ++v)
      if (data_.uneven[v]) {
        extra[v] = kSlopes;
        if (const Index image = layout_.image(v); image >= 0) extra[image] = kSlopes;
      }
    return extra;
  }

  Result<Fitted> solved(Draft draft) const {
    const auto solution = solve(layout_, draft, data_);
    if (!solution) return std::unexpected(solution.error());
    Solution stored = asStored(*solution, limits_.trace);
    dropSlopesAtTips(draft.surface, stored);
    return Fitted{std::move(draft), std::move(stored)};
  }
  DraftErrors measured(const Fitted& fitted) const {
    return measureDraft(layout_, fitted.draft, data_, fitted.solution);
  }

  // With other shape parameters, if the new fit is better and still within the limit on distance.
  Fitted reshaped(Fitted fitted, const DraftErrors& errors) const {
    if (!choosesShapes_) return fitted;
    progress_.reportFit("shape parameters", 0.92);
    Wireframe wireframe = fitted.draft.surface.wireframe();
    if (chooseShapes(layout_, fitted.draft, data_, fitted.solution, wireframe.ribbons) == 0)
      return fitted;
    auto surface = Surface::make(std::move(wireframe));
    if (!surface) return fitted;
    auto again = solved({fitted.draft.patches, std::move(*surface)});
    if (!again) return fitted;
    const DraftErrors now = measured(*again);
    if (now.largestDistance > limits_.distance || now.weightedSquares >= errors.weightedSquares)
      return fitted;
    return std::move(*again);
  }

  Layout& layout_;
  SourceData& data_;
  RefineLimits limits_;
  bool choosesShapes_;
  ConversionProgress& progress_;
};

}  // namespace

Result<Fitted> fitSurface(Layout& layout, SourceData& data, const RefineLimits& limits,
                          bool choosesShapes, ConversionProgress& progress, FitReach& reach) {
  return SurfaceFitter(layout, data, limits, choosesShapes, progress).run(reach);
}

}  // namespace sweepface
