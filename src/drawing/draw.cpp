// The drawing of a model: everything that is stored, by names.
#include "sweepface/drawing.hpp"

#include "drawing/frames.hpp"

namespace sweepface {

namespace drawing {
namespace {

class Drawer {
 public:
  explicit Drawer(const Rig& rig)
      : rig_(rig), s_(rig.surface), w_(s_.wireframe()), jets_(s_), nodesAt_(w_.points) {
    for (Index n = 0; n < nodeCount(); ++n)
      if (w_.nodes[n].point >= 0) nodesAt_[w_.nodes[n].point].push_back(n);
  }

  Drawing draw() {
    drawing_.units = rig_.names.units;
    drawing_.tolerance = rig_.tolerance;
    for (Index n = 0; n < nodeCount(); ++n) drawNode(n);
    for (Index a = 0; a < static_cast<Index>(w_.arcs.size()); ++a) drawCurve(a);
    for (Index p = 0; p < s_.patchCount(); ++p) drawPatch(p);
    for (Index r = 0; r < static_cast<Index>(w_.ribbons.size()); ++r)
      drawing_.ribbons.push_back({rig_.nameOf(Thing::ribbon, r), w_.ribbons[r], {}});
    for (const Target& target : rig_.targets) drawExpression(target);
    return std::move(drawing_);
  }

 private:
  Index nodeCount() const { return static_cast<Index>(w_.nodes.size()); }
  std::string nodeName(Index n) const { return rig_.nameOf(Thing::node, n); }
  std::string reference(HalfArc h) const {
    return (h & 1 ? "-" : "") + rig_.nameOf(Thing::curve, arcOf(h));
  }

  void drawNode(Index n) {
    Drawing::Node node;
    node.name = nodeName(n);
    if (w_.nodes[n].point >= 0) placeNode(node, n);
    drawing_.nodes.push_back(std::move(node));
  }

  // Nodes that share a point name the first of them; irregular ones share its vectors too.
  void placeNode(Drawing::Node& node, Index n) {
    if (!isFirst(n)) node.with = nodeName(nodesAt_[w_.nodes[n].point][0]);
    if (jets_.home(n) != n) return;
    node.at = rig_.neutral[jets_.at(n, 0)];
    auto& jet = node.jet.emplace();
    jet.along = reference(firstArm(n));
    for (int k = 1; k < 9; ++k)
      if (const Index v = jets_.at(n, k); v >= 0) jet.vectors[k] = rig_.neutral[v];
  }

  bool isFirst(Index n) const { return nodesAt_[w_.nodes[n].point][0] == n; }

  // The arm along which the x axis runs: at an irregular point the one at angle 0 of its chart.
  HalfArc firstArm(Index n) const {
    const Connectivity& c = s_.connectivity();
    if (c.kinds[n] == NodeKind::crossing) return c.stars[n].arms[0];
    for (Index m : nodesAt_[w_.nodes[n].point])
      for (HalfArc arm : c.stars[m].arms)
        if (jets_.home(m) == n && !w_.arcs[arcOf(arm)].collapsed &&
            chartAngle(s_, jets_, n, arm) == 0)
          return arm;
    return c.stars[n].arms[0];  // never: every chart begins with a spoke
  }

  void drawCurve(Index a) {
    const Arc& arc = w_.arcs[a];
    Drawing::Curve curve;
    curve.name = rig_.nameOf(Thing::curve, a);
    curve.from = nodeName(arc.from);
    curve.to = nodeName(arc.to);
    curve.edges = arc.edges;
    curve.ribbon = rig_.nameOf(Thing::ribbon, arc.ribbon);
    curve.collapsed = arc.collapsed;
    drawing_.curves.push_back(std::move(curve));
  }

  void drawPatch(Index p) {
    Drawing::Patch patch;
    patch.name = rig_.nameOf(Thing::patch, p);
    for (int s = 0; s < 4; ++s) {
      auto& side = patch.sides.emplace_back();
      for (HalfArc h : w_.side(p, s)) side.push_back(reference(h));
    }
    drawing_.patches.push_back(std::move(patch));
  }

  void drawExpression(const Target& target) {
    Drawing::Expression expression{target.name, {}, {}};
    for (Index n = 0; n < nodeCount(); ++n) {
      if (w_.nodes[n].point < 0 || jets_.home(n) != n) continue;
      Drawing::Move move;
      move.by = target.difference[jets_.at(n, 0)];
      for (int k = 1; k < 9; ++k)
        if (const Index v = jets_.at(n, k); v >= 0 && target.difference[v] != Vec3{})
          move.jet.emplace_back(k, target.difference[v]);
      if (move.by == Vec3{} && move.jet.empty() && isFirst(n)) continue;
      move.name = nodeName(n);
      expression.moves.push_back(std::move(move));
    }
    drawing_.expressions.push_back(std::move(expression));
  }

  const Rig& rig_;
  const Surface& s_;
  const Wireframe& w_;
  StoredJets jets_;
  std::vector<std::vector<Index>> nodesAt_;  // [points]
  Drawing drawing_;
};

}  // namespace
}  // namespace drawing

Drawing draw(const Rig& rig) { return drawing::Drawer(rig).draw(); }

}  // namespace sweepface
