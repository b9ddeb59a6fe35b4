#include "codec/wire_version1.hpp"

#include "codec/grid_size.hpp"
#include "surface/wireframe_checks.hpp"

namespace sweepface::codec {

namespace {

void readNodes(Reader& in, Wireframe& w) {
  const std::size_t count = in.count(2, "nodes");
  if (w.points > static_cast<std::int64_t>(count)) in.refuse("there are more points than nodes");
  Index point = -1;
  for (std::size_t n = 0; n < count && in.ok(); ++n) {
    Node node;
    node.point = point = in.step(point, -1, w.points, "point");
    node.stored = static_cast<JetMask>(in.number(0, kWholeJet + 1, "jet mask"));
    if (!isClosed(node.stored)) in.refuse("a jet stores a derivative without those before it");
    w.nodes.push_back(node);
  }
}

bool meetInOnePoint(const Wireframe& w, const Arc& arc) {
  const Index point = w.nodes[arc.from].point;
  return point >= 0 && point == w.nodes[arc.to].point;
}

void readArcs(Reader& in, Wireframe& w) {
  const std::size_t count = in.count(4, "arcs");
  const auto nodes = static_cast<Index>(w.nodes.size());
  Index from = 0, ribbon = 0;
  for (std::size_t a = 0; a < count && in.ok(); ++a) {
    Arc arc;
    arc.from = from = in.step(from, 0, nodes, "node");
    arc.to = in.step(from, 0, nodes, "node");
    const Index length = in.number(2, 2 * (kLongestArc + 1), "twice the length of an arc");
    arc.edges = length / 2;
    arc.collapsed = length % 2;
    arc.ribbon = ribbon = in.step(ribbon, 0, INT32_MAX, "ribbon");
    if (in.ok() && arc.collapsed && !meetInOnePoint(w, arc))
      in.refuse("a collapsed arc joins two points");
    w.arcs.push_back(arc);
  }
}

void readPatches(Reader& in, Wireframe& w) {
  const std::size_t count = in.count(8, "patches");
  const auto halves = static_cast<std::int64_t>(2 * w.arcs.size());
  HalfArc last = 0;
  for (std::size_t p = 0; p < count && in.ok(); ++p) {
    Patch patch;
    for (int s = 0; s < 4; ++s) {
      patch.sides[s] = static_cast<Index>(w.loops.size());
      const std::size_t size = in.count(1, "arcs on a side");
      if (size == 0) in.refuse("a patch lacks a side");
      for (std::size_t k = 0; k < size && in.ok(); ++k)
        w.loops.push_back(last = in.step(last, 0, halves, "half-arc"));
    }
    patch.sides[4] = static_cast<Index>(w.loops.size());
    if (patch.sides[4] - patch.sides[0] > kMostArcsAround)
      in.refuse("a patch has too many arcs around it");
    w.patches.push_back(patch);
  }
}

}  // namespace

Wireframe readWireframe(Reader& in) {
  Wireframe w;
  w.points = in.number(0, INT32_MAX, "number of points");
  readNodes(in, w);
  readArcs(in, w);
  readPatches(in, w);
  if (in.ok() && !isSmallEnough(w, kMostGridVertices))
    in.refuse("the patches have too many vertices");
  if (in.ok() && idleArc(w) >= 0) in.refuse("an arc bounds no patch");
  return w;
}

}  // namespace sweepface::codec
