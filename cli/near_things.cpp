#include "near_things.hpp"

#include <limits>

#include "sweepface/eval.hpp"

namespace sweepface::cli {
namespace {

constexpr Index kPerEdge = 4;

class Search {
 public:
  Search(const Rig& rig, const Vec3& point)
      : surface_(rig.surface),
        grid_(surface_, kPerEdge),
        positions_(grid_.positions(blend(rig, {}))),
        point_(point) {
    const Wireframe& w = surface_.wireframe();
    const NearPlace nowhere{{}, std::numeric_limits<double>::infinity()};
    found_.nodes.assign(w.nodes.size(), nowhere);
    found_.curves.assign(w.arcs.size(), nowhere);
    found_.patches.assign(surface_.patchCount(), nowhere);
  }

  NearThings run() {
    for (Index p = 0; p < surface_.patchCount(); ++p) {
      for (Index j = 0; j <= kPerEdge * surface_.edgesV(p); ++j)
        for (Index i = 0; i <= kPerEdge * surface_.edgesU(p); ++i)
          see(found_.patches[p], grid_.vertex(p, i, j));
      for (int side = 0; side < 4; ++side) goAlong(p, side);
    }
    return std::move(found_);
  }

 private:
  void see(NearPlace& nearest, Index vertex) const {
    const double distance = norm(positions_[vertex] - point_);
    if (distance < nearest.distance) nearest = {positions_[vertex], distance};
  }

  void goAlong(Index patch, int side) {
    const Wireframe& w = surface_.wireframe();
    Index first = 0;
    for (const HalfArc h : w.side(patch, side)) {
      const Index steps = kPerEdge * w.arcs[arcOf(h)].edges;
      see(found_.nodes[w.start(h)], grid_.sideVertex(patch, side, first));
      for (Index k = 0; k <= steps; ++k)
        see(found_.curves[arcOf(h)], grid_.sideVertex(patch, side, first + k));
      first += steps;
    }
  }

  const Surface& surface_;
  Tessellation grid_;
  std::vector<Vec3> positions_;
  Vec3 point_;
  NearThings found_;
};

}  // namespace

NearThings nearThings(const Rig& rig, const Vec3& point) { return Search(rig, point).run(); }

}  // namespace sweepface::cli
