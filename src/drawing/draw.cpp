// Makes the drawing of a model: everything that is stored, by name.
#include <algorithm>
#include <set>
#include <span>

#include "sweepface/drawing.hpp"

#include "codec/limits.hpp"
#include "drawing/frames.hpp"
#include "drawing/words.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {

namespace drawing {
namespace {

class Drawer {
 public:
  explicit Drawer(const Rig& rig)
      : rig_(rig),
        s_(rig.surface),
        w_(s_.wireframe()),
        jets_(s_),
        nodesAt_(w_.points),
        faceOfQuad_(faceOfQuads(rig)) {
    for (Index n = 0; n < nodeCount(); ++n)
      if (w_.nodes[n].point >= 0) nodesAt_[w_.nodes[n].point].push_back(n);
  }

  Drawing draw() {
    drawing_.units = rig_.names.units;
    drawing_.tolerance = rig_.tolerance;
    neutral_ = settled(rig_.neutral);
    for (Index n = 0; n < nodeCount(); ++n) drawNode(n);
    for (Index a = 0; a < static_cast<Index>(w_.arcs.size()); ++a) drawCurve(a);
    for (Index p = 0; p < s_.patchCount(); ++p) drawPatch(p);
    for (Index r = 0; r < static_cast<Index>(w_.ribbons.size()); ++r)
      drawing_.ribbons.push_back({rig_.nameOf(Thing::ribbon, r), w_.ribbons[r], {}});
    for (Index a = 0; a < static_cast<Index>(w_.arcs.size()); ++a)
      if (w_.arcs[a].crease) drawing_.creases.push_back({rig_.nameOf(Thing::curve, a), {}});
    for (const Target& target : rig_.targets)
      if (rig_.knows(target)) drawExpression(target);
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
    for (int f = 0; f < fanCount(n); ++f) {
      Drawing::Jet& jet = node.jets.emplace_back();
      jet.along = reference(firstArm(n, f));
      for (int k = 1; k < 9; ++k)
        if (const Index v = vectorOf(n, k, f); v >= 0) jet.vectors[k] = neutral_[v];
    }
  }

  int fanCount(Index n) const {
    return std::max(1, static_cast<int>(s_.connectivity().fans[n].size()));
  }

  // The vector of a derivative of a node, or of one of its fans; -1 if it is predicted.
  Index vectorOf(Index n, int k, int f) const { return jetVector(s_, jets_, n, k, f); }

  bool isFirst(Index n) const { return nodesAt_[w_.nodes[n].point][0] == n; }

  // The arm along which the x axis runs: at an irregular point the one at angle 0 of its chart.
  HalfArc firstArm(Index n, int f) const {
    const Connectivity& c = s_.connectivity();
    const auto& own = c.stars[n].arms;
    if (c.kinds[n] == NodeKind::creased)
      return own[static_cast<std::size_t>(c.fans[n][f].first) % own.size()];
    if (c.kinds[n] == NodeKind::crossing) return own[0];
    for (Index m : nodesAt_[w_.nodes[n].point])
      for (HalfArc arm : c.stars[m].arms)
        if (jets_.home(m) == n && !w_.arcs[arcOf(arm)].collapsed &&
            chartAngle(s_, jets_, n, arm) == 0)
          return arm;
    return own[0];  // never: every chart begins with a spoke
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
    patch.material = materialOf(p);
    drawing_.patches.push_back(std::move(patch));
  }

  // The material of all source faces on a patch; empty if they differ, if it is not known, or if
  // the name is not a text that could be read again. Call this for the patches in order.
  std::string materialOf(Index p) {
    const Polygons& faces = rig_.source.polygons;
    if (faceOfQuad_.empty() || faces.faceMaterial.empty()) return {};
    const auto quads = static_cast<std::size_t>(s_.edgesU(p) * s_.edgesV(p));
    std::set<Index> materials;
    for (const Index face : std::span(faceOfQuad_).subspan(quadsDrawn_, quads))
      materials.insert(faces.faceMaterial[face]);
    quadsDrawn_ += quads;
    if (materials.size() != 1 || *materials.begin() < 0) return {};
    const std::string& name = faces.materials[*materials.begin()];
    return isName(name) && name.size() <= codec::kLongestName ? name : std::string();
  }

  void drawExpression(const Target& target) {
    Drawing::Expression expression{target.name, {}, {}};
    const std::vector<Vec3> offsets = settled(target.difference);
    for (Index n = 0; n < nodeCount(); ++n) {
      if (w_.nodes[n].point < 0 || jets_.home(n) != n) continue;
      Drawing::Move move;
      move.by = offsets[jets_.at(n, 0)];
      bool rests = move.by == Vec3{} && isFirst(n);
      for (int f = 0; f < fanCount(n); ++f) {
        auto& jet = move.jets.emplace_back();
        for (int k = 1; k < 9; ++k)
          if (const Index v = vectorOf(n, k, f); v >= 0 && offsets[v] != Vec3{})
            jet.emplace_back(k, offsets[v]);
        rests = rests && jet.empty();
      }
      if (rests) continue;
      move.name = nodeName(n);
      expression.moves.push_back(std::move(move));
    }
    drawing_.expressions.push_back(std::move(expression));
  }

  std::vector<Vec3> settled(const std::vector<Vec3>& stored) const {
    std::vector<Vec3> vectors(s_.vectorCount());
    s_.settle(stored, vectors);
    return vectors;
  }

  const Rig& rig_;
  const Surface& s_;
  const Wireframe& w_;
  StoredJets jets_;
  std::vector<std::vector<Index>> nodesAt_;  // [points]
  std::vector<Vec3> neutral_;                // settled
  std::vector<Index> faceOfQuad_;            // [grid quads], or empty
  std::size_t quadsDrawn_ = 0;
  Drawing drawing_;
};

}  // namespace
}  // namespace drawing

Drawing draw(const Rig& rig) { return drawing::Drawer(rig).draw(); }

}  // namespace sweepface
