// How many edges a curve has where nobody says: opposite sides of a patch have as many.
#include <deque>
#include <fmt/format.h>

#include "drawing/weave.hpp"

namespace sweepface::drawing {

namespace {

constexpr std::int64_t kMostEdges = 65535;

class EdgeChooser {
 public:
  EdgeChooser(const Drawing& drawing, Wireframe& wireframe) : d_(drawing), w_(wireframe) {
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
    // Curves that share a side first: the curve opposite to them is as long as they are together.
    for (const bool shared : {true, false})
      for (Index p = 0; p < patchCount(); ++p)
        for (int s = 0; s < 4; ++s)
          for (HalfArc h : w_.side(p, s)) {
            if (w_.arcs[arcOf(h)].edges > 0 || (shared && w_.side(p, s).size() == 1)) continue;
            set(arcOf(h), kDefaultEdges);
            if (auto ok = settle(); !ok) return ok;
          }
    return check();
  }

 private:
  Index patchCount() const { return static_cast<Index>(w_.patches.size()); }

  // What a side's curves are known to have together, and how many of them say nothing.
  struct Side {
    std::int64_t known = 0;
    int unknowns = 0;
  };
  Side& side(Index patch, int s) { return sides_[4 * patch + s]; }
  const Side& side(Index patch, int s) const { return sides_[4 * patch + s]; }

  void set(Index arc, Index edges) {
    w_.arcs[arc].edges = edges;
    for (Index k : sidesOf_[arc]) {
      sides_[k].known += edges;
      --sides_[k].unknowns;
      due_.push_back(k / 4);
    }
  }

  void setLast(Index patch, int s, Index edges) {
    for (HalfArc h : w_.side(patch, s))
      if (w_.arcs[arcOf(h)].edges == 0) return set(arcOf(h), edges);
  }

  // Whatever follows from what is known.
  Result<void> settle() {
    for (; !due_.empty(); due_.pop_front())
      for (int s = 0; s < 2; ++s) {
        const Index p = due_.front();
        const int open = side(p, s).unknowns > 0 ? s : s + 2, told = 2 * s + 2 - open;
        if (side(p, told).unknowns != 0 || side(p, open).unknowns != 1) continue;
        const std::int64_t left = side(p, told).known - side(p, open).known;
        if (left < 1 || left > kMostEdges) return mismatch(p, s);
        setLast(p, open, static_cast<Index>(left));
      }
    return {};
  }

  std::unexpected<Error> mismatch(Index p, int s) const {
    const std::string& name = d_.patches[p].name;
    return failAt(d_, d_.patches[p].place,
                  fmt::format("sides {} and {} of patch {} have {} and {} edges; opposite sides "
                              "need as many: give their curves 'edges' that agree",
                              s + 1, s + 3, name.empty() ? std::to_string(p) : "'" + name + "'",
                              side(p, s).known, side(p, s + 2).known));
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
  Wireframe& w_;
  std::vector<Side> sides_;                  // [4·patches]
  std::vector<std::vector<Index>> sidesOf_;  // [arcs] places in sides_
  std::deque<Index> due_;                    // patches to look at
};

}  // namespace

Result<void> chooseEdges(const Drawing& drawing, Wireframe& wireframe) {
  return EdgeChooser(drawing, wireframe).choose();
}

}  // namespace sweepface::drawing
