#include "fit/refine.hpp"

#include <algorithm>
#include <utility>

#include "fit/split_patch.hpp"

namespace sweepface {

namespace {

class Refiner {
 public:
  Refiner(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
          const RefineLimits& limits, ExtraJets& extra)
      : layout_(layout),
        draft_(draft),
        data_(data),
        errors_(errors),
        limits_(limits),
        extra_(extra) {}

  Index run() {
    for (const auto& [patch, excess] : patchesBeyond()) improve(patch, excess);
    const Index stalled = draft_.surface.patchCount() / 500;
    if (changed_ <= stalled && !unfolding_) emphasizePlaces();
    return changed_;
  }

 private:
  struct Beyond {
    Index patch;
    double excess;  // the worst error there, relative to its limit
  };

  // The worst first.
  std::vector<Beyond> patchesBeyond() const {
    constexpr double kFolded = 1.5;
    std::vector<Beyond> found;
    for (Index p = 0; p < draft_.surface.patchCount(); ++p) {
      double worst = errors_.folded[p] ? kFolded : 0;
      for (const Index v : draft_.patches[p].vertices)
        worst = std::max(
            {worst, errors_.distance[v] / limits_.distance, errors_.angle[v] / limits_.angle});
      if (worst > 1) found.push_back({p, worst});
    }
    std::ranges::sort(found, {}, [](const Beyond& b) { return std::pair(-b.excess, b.patch); });
    return found;
  }

  void improve(Index p, double excess) {
    const GridPatch& grid = draft_.patches[p];
    const bool folded = errors_.folded[p] != 0;
    if (!folded && isNearly(excess) && emphasize(grid))
      count(false);
    else if (splitPatch(layout_, grid, data_))
      count(folded);
    else
      for (const Index v : grid.vertices) improveNode(v, folded);
  }

  // A patch that is nearly within the limits may get there without more points if the errors at its
  // worst vertices count more (Lawson's way from least squares to least maximum). That costs
  // smoothness: where normals matter, it is tried less.
  bool isNearly(double excess) const { return excess < (limits_.smooth ? 1.5 : 3); }
  bool emphasize(const GridPatch& grid) {
    const double most = limits_.smooth ? 4 : 64;
    bool any = false;
    const auto raise = [&](double& emphasis) {
      if (emphasis >= most) return;
      emphasis *= 2;
      any = true;
    };
    for (const Index v : grid.vertices) {
      if (errors_.distance[v] > limits_.distance) raise(placeEmphasis(v));
      if (errors_.angle[v] > limits_.angle) raise(slopeEmphasis(v));
    }
    return any;
  }

  // In a patch too small to split, T-nodes become crossings. Near folds, slopes are stored, and if
  // they already are, they are kept short.
  void improveNode(Index v, bool folded) {
    if (layout_.isNode(v) && !layout_.isFull(v)) {
      layout_.extend(v);
      return count(folded);
    }
    if (!limits_.smooth || !errors_.nearFold[v]) return;
    if ((extra_[v] & kSlopes) != kSlopes)
      extra_[v] |= kSlopes;
    else if (!data_.uneven[v])
      data_.uneven[v] = 1;
    else
      return;
    count(true);
  }

  // Little is left to cut: positions that are too far off get more weight than their surroundings.
  void emphasizePlaces() {
    for (Index v = 0; v < layout_.mesh().vertexCount(); ++v)
      if (errors_.distance[v] > limits_.distance) {
        placeEmphasis(v) *= 8;
        ++changed_;
      }
  }

  double& placeEmphasis(Index v) { return data_.placeEmphasis[layout_.mesh().point[v]]; }
  double& slopeEmphasis(Index v) { return data_.slopeEmphasis[layout_.mesh().point[v]]; }
  void count(bool unfolds) {
    ++changed_;
    unfolding_ |= unfolds;
  }

  Layout& layout_;
  const Draft& draft_;
  SourceData& data_;
  const DraftErrors& errors_;
  const RefineLimits& limits_;
  ExtraJets& extra_;
  Index changed_ = 0;
  bool unfolding_ = false;
};

}  // namespace

Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
             const RefineLimits& limits, ExtraJets& extra) {
  return Refiner(layout, draft, data, errors, limits, extra).run();
}

}  // namespace sweepface
