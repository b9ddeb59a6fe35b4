#include "drawing/frames.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface::drawing {

std::optional<int> placeInStar(const Connectivity& connectivity, Index node, HalfArc arm) {
  const auto& arms = connectivity.stars[node].arms;
  const auto found = std::ranges::find(arms, arm);
  if (found == arms.end()) return std::nullopt;
  return static_cast<int>(found - arms.begin());
}

double chartAngle(const Surface& surface, const StoredJets& jets, Index node, HalfArc arm) {
  // The arm's derivative is r cos(angle) times that by x plus r sin(angle) times that by y.
  const JetRef along = surface.alongJet(arm, 1);
  double x = 0, y = 0;
  for (const Term& t : surface.derivation(along.vector)) {
    if (t.vector == jets.at(node, 3)) x = along.sign * t.factor;
    if (t.vector == jets.at(node, 1)) y = along.sign * t.factor;
  }
  return std::atan2(y, x);
}

Jet turnedJet(const Jet& jet, double angle) {
  if (angle == 0) return jet;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 &x = jet[3], &y = jet[1], &xx = jet[6], &xy = jet[4], &yy = jet[2];
  Jet result{};
  result[0] = jet[0];
  result[3] = x * c - y * s;
  result[1] = x * s + y * c;
  result[6] = xx * (c * c) - xy * (2 * c * s) + yy * (s * s);
  result[4] = xx * (c * s) + xy * (c * c - s * s) - yy * (c * s);
  result[2] = xx * (s * s) + xy * (2 * c * s) + yy * (c * c);
  return result;
}

Index jetVector(const Surface& surface, const StoredJets& jets, Index node, int component,
                int fan) {
  const Index stored = jets.at(node, component, fan);
  const Connectivity& c = surface.connectivity();
  if (stored >= 0 || c.kinds[node] != NodeKind::creased || !c.fans[node][fan].regular)
    return stored;
  const auto& sectors = c.stars[node].sectors;
  const Index corner = sectors[static_cast<std::size_t>(c.fans[node][fan].first) % sectors.size()];
  return surface.cornerJet(corner / 4, corner % 4, component / 3, component % 3).vector;
}

}  // namespace sweepface::drawing
