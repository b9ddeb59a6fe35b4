// The sizes of things as drawn.
#include "sweepface/box.hpp"

#include "drawing/bend.hpp"
#include "drawing/weave.hpp"

namespace sweepface::drawing {

double diagonalOf(const Drawing& d) {
  Box box;
  for (const Drawing::Node& node : d.nodes)
    if (node.at) box.include(*node.at);
  for (const Drawing::Curve& curve : d.curves)
    for (const Vec3& point : curve.points) box.include(point);
  return norm(box.size());
}

namespace {

class PatchMeter {
 public:
  PatchMeter(const Drawing& drawing, const Woven& woven) : w_(woven.wireframe) {
    double sum = 0, edges = 0, known = 0;
    for (Index a = 0; a < static_cast<Index>(w_.arcs.size()); ++a) {
      lengths_.push_back(woven.lengthOf(drawing, a));
      if (lengths_.back() > 0) sum += lengths_.back(), edges += w_.arcs[a].edges, ++known;
    }
    if (known > 0) unit_ = sum / known, edge_ = sum / edges;
  }

  PatchSize sizeOf(Index patch) const { return {between(patch, 0), between(patch, 1)}; }

 private:
  // The mean length of a side and the opposite one, of those that are known; else a length by their
  // edges.
  double between(Index patch, int side) const {
    double sum = 0, known = 0, edges = 0;
    for (const int s : {side, side + 2}) {
      double length = 0;
      bool whole = true;
      edges = 0;
      for (HalfArc h : w_.side(patch, s)) {
        const Arc& arc = w_.arcs[arcOf(h)];
        length += lengths_[arcOf(h)];
        whole = whole && (lengths_[arcOf(h)] > 0 || arc.collapsed);
        edges += arc.edges;
      }
      if (whole) sum += length, ++known;
    }
    return (sum > 0 ? sum / known : edges * edge_) / unit_;
  }

  const Wireframe& w_;
  std::vector<double> lengths_;  // [arcs] 0 where unknown
  double unit_ = 1, edge_ = 1;   // the mean lengths of a curve and of an edge
};

}  // namespace

std::vector<PatchSize> patchSizes(const Drawing& drawing, const Woven& woven) {
  const PatchMeter meter(drawing, woven);
  std::vector<PatchSize> sizes;
  for (Index p = 0; p < static_cast<Index>(woven.wireframe.patches.size()); ++p)
    sizes.push_back(meter.sizeOf(p));
  return sizes;
}

}  // namespace sweepface::drawing
