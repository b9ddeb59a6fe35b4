#include <algorithm>
#include <cmath>

#include "sweepface/surface.hpp"

#include "surface/creases.hpp"
#include "surface/inward.hpp"

namespace sweepface {

namespace {

// Position and derivatives across an arc, seen from the patch on a half-arc's left: `first` points
// into that patch.
struct CrossJet {
  Vec3 position, first, second, normal;
};

CrossJet crossJet(const Surface& surface, std::span<const Vec3> vectors, HalfArc h, double t) {
  const Site site = surface.siteOnArc(h, t);
  const Inward way(surface, h);
  CrossJet jet;
  jet.position = surface.evaluate(vectors, site);
  jet.first =
      way.direction * surface.evaluate(vectors, site, way.alongV ? 0 : 1, way.alongV ? 1 : 0);
  jet.second = surface.evaluate(vectors, site, way.alongV ? 0 : 2, way.alongV ? 2 : 0);
  jet.normal = surface.normal(vectors, site);
  return jet;
}

}  // namespace

void JoinSummary::add(const JoinReport& join) {
  ++count;
  length += join.length;
  positionGap = std::max(positionGap, join.positionGap);
  firstJump = std::max(firstJump, join.firstJump);
  secondJump = std::max(secondJump, join.secondJump);
  normalJump = std::max(normalJump, join.normalJump);
  normalSquares += join.length * join.normalJump * join.normalJump;
}

double JoinSummary::normalRms() const { return length > 0 ? std::sqrt(normalSquares / length) : 0; }

namespace {

// Whether the two sectors beside an arm of a creased node share one jet.
bool isInsideRegularFan(const Connectivity& c, Index node, HalfArc arm) {
  const auto& arms = c.stars[node].arms;
  const auto count = static_cast<int>(arms.size());
  const int place = static_cast<int>(std::find(arms.begin(), arms.end(), arm) - arms.begin());
  return std::ranges::any_of(c.fans[node], [&](const Fan& fan) {
    const int k = (place - fan.first + count) % count;
    return fan.regular && k > 0 && k < fan.sectors;
  });
}

}  // namespace

JoinClass joinClass(const Surface& surface, Index arc) {
  const auto& c = surface.connectivity();
  const auto& w = surface.wireframe();
  if (c.patchOf[2 * arc] < 0 || c.patchOf[2 * arc + 1] < 0) return JoinClass::boundary;
  if (w.arcs[arc].crease) return JoinClass::crease;
  // A pole is smooth: its chart turns with the rays. Only a true irregular node breaks the line.
  for (HalfArc h : {2 * arc, 2 * arc + 1}) {
    HalfArc end = c.rails[h].last;
    const Index node = w.end(end);
    if (c.kinds[node] == NodeKind::creased && !isInsideRegularFan(c, node, twin(end)))
      return JoinClass::spoke;
    if (c.kinds[node] != NodeKind::irregular) continue;
    const Star& star = c.stars[node];
    const bool rib = !star.closed && star.sectors.size() == 2 &&
                     w.arcs[arcOf(star.arms[0])].collapsed && w.arcs[arcOf(star.arms[2])].collapsed;
    if (!rib) return JoinClass::spoke;
  }
  return JoinClass::c2;
}

std::vector<JoinReport> examineJoins(const Surface& surface, std::span<const Vec3> vectors,
                                     int samples) {
  const auto& w = surface.wireframe();
  std::vector<JoinReport> reports(w.arcs.size());
  double firstScale = 0, secondScale = 0;
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    JoinReport& r = reports[a];
    r.joinClass = joinClass(surface, a);
    r.collapsed = w.arcs[a].collapsed;
    const double edges = w.arcs[a].edges;
    Vec3 last = surface.pointOnArc(vectors, a, 0);
    for (int k = 1; k <= 4 * w.arcs[a].edges; ++k) {
      const Vec3 p = surface.pointOnArc(vectors, a, k * 0.25);
      r.length += norm(p - last);
      last = p;
    }
    if (r.joinClass == JoinClass::boundary) continue;
    for (int k = 0; k < samples; ++k) {
      const double t = edges * (samples > 1 ? static_cast<double>(k) / (samples - 1) : 0.5);
      const CrossJet left = crossJet(surface, vectors, 2 * a, t);
      const CrossJet right = crossJet(surface, vectors, 2 * a + 1, edges - t);
      firstScale = std::max({firstScale, norm(left.first), norm(right.first)});
      secondScale = std::max({secondScale, norm(left.second), norm(right.second)});
      r.positionGap = std::max(r.positionGap, norm(left.position - right.position));
      r.firstJump = std::max(r.firstJump, norm(left.first + right.first));
      r.secondJump = std::max(r.secondJump, norm(left.second - right.second));
      r.normalJump = std::max(r.normalJump, angleDegrees(left.normal, right.normal));
    }
  }
  for (JoinReport& r : reports) {
    if (firstScale > 0) r.firstJump /= firstScale;
    if (secondScale > 0) r.secondJump /= secondScale;
  }
  return reports;
}

}  // namespace sweepface
