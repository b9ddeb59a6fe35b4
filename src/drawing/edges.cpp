// Chooses numbers of edges where none are given. Opposite sides of a patch have the same number,
// and edges are about equally long, since derivatives are per edge and are shared where curves run
// on.
#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>

#include "codec/grid_size.hpp"
#include "drawing/weave.hpp"
#include "surface/union_find.hpp"

namespace sweepface::drawing {

namespace {

class EdgeChooser {
 public:
  EdgeChooser(const Drawing& drawing, Woven& woven)
      : d_(drawing), woven_(woven), w_(woven.wireframe), like_(arcCount()) {
    sides_.resize(4 * w_.patches.size());
    sidesOf_.resize(w_.arcs.size());
    for (Index p = 0; p < patchCount(); ++p) {
      for (int s = 0; s < 4; ++s)
        for (HalfArc h : w_.side(p, s)) {
          const Index edges = w_.arcs[arcOf(h)].edges;
          sidesOf_[arcOf(h)].push_back(4 * p + s);
          side(p, s).known += edges;
          side(p, s).unknowns += edges == 0;
        }
      due_.push_back(p);
    }
  }

  Result<void> choose() {
    if (auto ok = settle(); !ok) return ok;
    measure();
    // Curves that share a side come first, since the curve opposite has as many edges as they have
    // together.
    for (const bool shared : {true, false})
      for (Index p = 0; p < patchCount(); ++p)
        for (int s = 0; s < 4; ++s)
          for (HalfArc h : w_.side(p, s)) {
            if (w_.arcs[arcOf(h)].edges > 0 || (shared && w_.side(p, s).size() == 1)) continue;
            set(arcOf(h), usualEdges(arcOf(h)));
            if (auto ok = settle(); !ok) return ok;
          }
    return check();
  }

 private:
  Index arcCount() const { return static_cast<Index>(w_.arcs.size()); }
  Index patchCount() const { return static_cast<Index>(w_.patches.size()); }

  // The known edges of a side's curves together, and how many of the curves are still unknown.
  struct Side {
    std::int64_t known = 0;
    int unknowns = 0;
  };
  Side& side(Index patch, int s) { return sides_[4 * patch + s]; }
  const Side& side(Index patch, int s) const { return sides_[4 * patch + s]; }
  const Side& opposite(Index k) const { return side(k / 4, (k + 2) % 4); }

  void set(Index arc, Index edges) {
    w_.arcs[arc].edges = edges;
    for (Index k : sidesOf_[arc]) {
      sides_[k].known += edges;
      --sides_[k].unknowns;
      due_.push_back(k / 4);
    }
  }

  // Computes the mean length of each set of curves that must have equally many edges, and that of
  // an edge.
  void measure() {
    for (Index p = 0; p < patchCount(); ++p)
      for (int s = 0; s < 2; ++s)
        if (w_.side(p, s).size() == 1 && w_.side(p, s + 2).size() == 1)
          like_.join(arcOf(w_.side(p, s)[0]), arcOf(w_.side(p, s + 2)[0]));
    lengths_.resize(w_.arcs.size());
    Mean all, told;
    for (Index a = 0; a < arcCount(); ++a) {
      const double length = woven_.lengthOf(d_, a);
      if (!(length > 0)) continue;
      lengths_[like_.find(a)].add(length, 1);
      all.add(length, 1);
      if (d_.curves[a].edges > 0) told.add(length, d_.curves[a].edges);
    }
    edgeLength_ = told.count > 0 ? told.value() : all.value() / kUsualEdges;
  }

  struct Mean {
    double sum = 0, count = 0;
    void add(double x, double weight) { sum += x, count += weight; }
    double value() const { return count > 0 ? sum / count : 0; }
  };

  double edgesByLength(Index a) {
    const Mean& length = lengths_[like_.find(a)];
    return length.count > 0 && edgeLength_ > 0 ? length.value() / edgeLength_ : kUsualEdges;
  }

  // The edges of a curve by its length; if the opposite side is known, its share of what that
  // leaves.
  Index usualEdges(Index a) {
    double edges = edgesByLength(a), most = codec::kLongestArc;
    for (const Index k : sidesOf_[a]) {
      if (opposite(k).unknowns > 0) continue;
      const auto left = static_cast<double>(opposite(k).known - sides_[k].known);
      double all = 0;
      for (const HalfArc h : w_.side(k / 4, k % 4))
        if (w_.arcs[arcOf(h)].edges == 0) all += edgesByLength(arcOf(h));
      if (all > 0) edges = left * edgesByLength(a) / all;
      most = std::min(most, left - (sides_[k].unknowns - 1));
    }
    const double least = w_.arcs[a].from == w_.arcs[a].to && !w_.arcs[a].collapsed ? 3 : 1;
    return static_cast<Index>(std::clamp(std::round(edges), least, std::max(least, most)));
  }

  void setLast(Index patch, int s, Index edges) {
    for (HalfArc h : w_.side(patch, s))
      if (w_.arcs[arcOf(h)].edges == 0) return set(arcOf(h), edges);
  }

  // Sets whatever follows from what is known.
  Result<void> settle() {
    for (; !due_.empty(); due_.pop_front())
      for (int s = 0; s < 2; ++s) {
        const Index p = due_.front();
        const int open = side(p, s).unknowns > 0 ? s : s + 2, told = 2 * s + 2 - open;
        if (side(p, told).unknowns != 0 || side(p, open).unknowns != 1) continue;
        const std::int64_t left = side(p, told).known - side(p, open).known;
        if (left < 1) return tooFew(p, open);
        if (left > codec::kLongestArc) return mismatch(p, s);
        setLast(p, open, static_cast<Index>(left));
      }
    return {};
  }

  std::unexpected<Error> mismatch(Index p, int s) const {
    return failAt(
        d_, d_.patches[p].place,
        fmt::format("sides {} and {} of {} have {} and {} edges; opposite sides need as "
                    "many: give their curves 'edges' that agree",
                    s + 1, s + 3, quotedPatch(d_, p), side(p, s).known, side(p, s + 2).known));
  }

  // The error that side `s` leaves nothing for the last of its curves.
  std::unexpected<Error> tooFew(Index p, int s) const {
    return failAt(d_, d_.patches[p].place,
                  fmt::format("side {} of {} has {} edges, not counting a curve without 'edges', "
                              "and side {} has {}; opposite sides need as many: give their curves "
                              "'edges' that agree",
                              s + 1, quotedPatch(d_, p), side(p, s).known, (s + 2) % 4 + 1,
                              side(p, (s + 2) % 4).known));
  }

  Result<void> check() const {
    std::int64_t quads = 0;
    for (Index p = 0; p < patchCount(); ++p) {
      for (int s = 0; s < 2; ++s)
        if (side(p, s).known != side(p, s + 2).known) return mismatch(p, s);
      const std::int64_t m = side(p, 0).known, n = side(p, 1).known;
      quads += m > kMostQuads || n > kMostQuads ? kMostQuads + 1 : m * n;
      if (quads > kMostQuads)
        return failAt(d_, d_.patches[p].place,
                      fmt::format("the patches have more than {} quads together; give their "
                                  "curves fewer 'edges'",
                                  kMostQuads));
    }
    return {};
  }

  const Drawing& d_;
  const Woven& woven_;
  Wireframe& w_;
  UnionFind like_;             // curves that must have equally many edges
  std::vector<Mean> lengths_;  // [sets of curves]
  double edgeLength_ = 0;
  std::vector<Side> sides_;                  // [4·patches]
  std::vector<std::vector<Index>> sidesOf_;  // [arcs] indices into sides_
  std::deque<Index> due_;                    // patches to examine
};

}  // namespace

Result<void> chooseEdges(const Drawing& drawing, Woven& woven) {
  return EdgeChooser(drawing, woven).choose();
}

}  // namespace sweepface::drawing
