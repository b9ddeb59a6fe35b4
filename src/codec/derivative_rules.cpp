#include "codec/derivative_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweepface::codec {

DerivativeRules::DerivativeRules(const Surface& surface, const std::vector<CodedSite>& sites,
                                 const std::vector<Index>& siteOf)
    : surface_(surface),
      w_(surface.wireframe()),
      c_(surface.connectivity()),
      sites_(sites),
      siteOf_(siteOf),
      nodesAt_(w_.points) {
  for (std::size_t n = 0; n < w_.nodes.size(); ++n)
    if (c_.kinds[n] == NodeKind::irregular)
      nodesAt_[w_.nodes[n].point].push_back(static_cast<Index>(n));
}

void DerivativeRules::predict(const CodedSite& site, const StoredVector& s, Terms& terms) const {
  if (c_.kinds[site.node] == NodeKind::irregular)
    atHub(site, s, terms);
  else if (c_.kinds[site.node] == NodeKind::crossing)
    atCrossing(site, s, terms);
}

Index DerivativeRules::derivative(Index node, int i, int j) const {
  const CodedSite& site = sites_[siteOf_[node]];
  for (Index v = site.first; v < site.first + site.count; ++v)
    if (surface_.stored(v).i == i && surface_.stored(v).j == j) return v;
  return -1;
}

LineNeighbour<DerivativeRules::Reached> DerivativeRules::neighbour(Index node, int arm) const {
  LineNeighbour<Reached> n;
  const Star& star = c_.stars[node];
  if (arm >= static_cast<int>(star.arms.size())) return n;
  const Rail& rail = c_.rails[star.arms[arm]];
  n.value.back = twin(rail.last);
  n.value.node = w_.start(n.value.back);
  if (placeAll(n.value.node, n.value.position)) n.distance = rail.edges;
  return n;
}

bool DerivativeRules::placeAll(Index node, FewTerms& terms) const {
  if (isSite(node)) {
    terms.push_back({sites_[siteOf_[node]].first, 1});
    return true;
  }
  const auto [ahead, behind] = c_.stars[node].line();
  const Rail &a = c_.rails[ahead], &b = c_.rails[behind];
  const Index to = w_.end(a.last), from = w_.end(b.last);
  if (!isSite(to) || !isSite(from)) return false;
  const double length = a.edges + b.edges;
  // A Hermite cubic if the slopes along the line are known at both ends, else a straight line.
  const double t = b.edges / length;
  FewTerms slopeTo, slopeFrom;
  if (slope(to, twin(a.last), slopeTo) && slope(from, twin(b.last), slopeFrom)) {
    const double s = 1 - t;
    terms.push_back({sites_[siteOf_[from]].first, s * s * (1 + 2 * t)});
    terms.push_back({sites_[siteOf_[to]].first, t * t * (1 + 2 * s)});
    addTerms(terms, slopeFrom, t * s * s * length);
    addTerms(terms, slopeTo, s * t * t * length);
  } else {
    terms.push_back({sites_[siteOf_[from]].first, 1 - t});
    terms.push_back({sites_[siteOf_[to]].first, t});
  }
  return true;
}

bool DerivativeRules::slope(Index node, HalfArc h, FewTerms& terms) const {
  if (c_.kinds[node] != NodeKind::crossing) return false;
  const HalfArc back = c_.opposite(w_, h);
  if (back < 0) return false;
  const Rail &ahead = c_.rails[h], &behind = c_.rails[back];
  if (!isSite(w_.end(ahead.last)) || !isSite(w_.end(behind.last))) return false;
  const auto at = [&](const Rail& rail) {
    return LineNeighbour<Index>{static_cast<double>(rail.edges), position(w_.end(rail.last))};
  };
  const auto add = [&](Index vector, double factor) { terms.push_back({vector, factor}); };
  derivativeFromValues(LineNeighbours<Index>{at(ahead), at(behind)}, 1, add,
                       [&](double factor) { add(position(node), factor); });
  return true;
}

void DerivativeRules::atCrossing(const CodedSite& site, const StoredVector& s, Terms& terms) const {
  const Index node = site.node;
  const int d = s.i > 0 ? 0 : 1;
  if (s.i + s.j == 1)
    along(neighbours(node, d), site.first, -1, 1, terms);
  else if (s.i == 1 && s.j == 1)
    mixed(node, terms);
  else if (std::max(s.i, s.j) == 2 && std::min(s.i, s.j) == 0)
    along(neighbours(node, d), site.first, derivative(node, d == 0, d == 1), 2, terms);
}

void DerivativeRules::along(const LineNeighbours<Reached>& at, Index own, Index slope, int order,
                            Terms& terms) const {
  const auto add = [&](const Reached& n, double factor) { addTerms(terms, n.position, factor); };
  const auto addOwn = [&](Index vector) {
    return [&terms, vector](double factor) { terms.push_back({vector, factor}); };
  };
  if (slope < 0)
    derivativeFromValues(at, order, add, addOwn(own));
  else
    derivativeFromSlope(at, add, addOwn(own), addOwn(slope));
}

void DerivativeRules::mixed(Index node, Terms& terms) const {
  std::array<FewTerms, 2> change;
  int known = 0;
  for (int d = 0; d < 2; ++d) known += changeAcross(node, neighbours(node, 1 - d), d, change[d]);
  for (const FewTerms& t : change) addTerms(terms, t, 1.0 / std::max(1, known));
}

bool DerivativeRules::changeAcross(Index node, const LineNeighbours<Reached>& at, int d,
                                   FewTerms& terms) const {
  const Index own = derivative(node, d == 0, d == 1);
  if (own < 0) return false;
  LineNeighbours<FewTerms> across;
  for (int e = 0; e < 2; ++e)
    if (at[e].has() && isSite(at[e].value.node) &&
        slopeAcross(at[e].value, (d == 0) == (e == 0), across[e].value))
      across[e].distance = at[e].distance;
  derivativeFromValues(
      across, 1, [&](const FewTerms& slope, double factor) { addTerms(terms, slope, factor); },
      [&](double factor) { terms.push_back({own, factor}); });
  return across[0].has() || across[1].has();
}

bool DerivativeRules::slopeAcross(const Reached& n, bool right, FewTerms& terms) const {
  if (c_.kinds[n.node] != NodeKind::crossing || !c_.stars[n.node].closed) return false;
  const auto& arms = c_.stars[n.node].arms;
  const auto back = std::ranges::find(arms, n.back) - arms.begin();
  // `back` points against travel; the arm after it, counter-clockwise, points to the right.
  const int arm = static_cast<int>(back + (right ? 1 : 3)) % 4;
  const Index stored = derivative(n.node, arm % 2 == 0, arm % 2 == 1);
  if (stored >= 0) {
    terms.push_back({stored, arm < 2 ? 1.0 : -1.0});
    return true;
  }
  return slope(n.node, arms[arm], terms);
}

void DerivativeRules::atHub(const CodedSite& site, const StoredVector& s, Terms& terms) const {
  if (s.i + s.j != 1) return;
  double xx = 0, xy = 0, yy = 0;
  Terms x, y;
  for (const auto& [node, arm] : spokes(site)) {
    const HalfArc h = c_.stars[node].arms[arm];
    const auto n = neighbour(node, arm);
    if (!n.has()) continue;
    double a = 0, b = 0;
    for (const Term& t : surface_.derivation(surface_.alongJet(h, 1).vector)) {
      const double rounded = std::round(t.factor * 1048576) / 1048576;
      if (t.vector == site.first + 1) a = rounded;
      if (t.vector == site.first + 2) b = rounded;
    }
    xx += a * a, xy += a * b, yy += b * b;
    const double out = 1 / n.distance;
    addTerms(x, n.value.position, a * out), x.push_back({site.first, -a * out});
    addTerms(y, n.value.position, b * out), y.push_back({site.first, -b * out});
  }
  const double d = xx * yy - xy * xy;
  if (!(d > 1e-3)) return;
  addTerms(terms, x, (s.i == 1 ? yy : -xy) / d);
  addTerms(terms, y, (s.i == 1 ? -xy : xx) / d);
}

std::vector<std::pair<Index, int>> DerivativeRules::spokes(const CodedSite& site) const {
  std::vector<std::pair<Index, int>> result;
  const Index point = w_.nodes[site.node].point;
  for (const Index node : nodesAt_[point]) {
    const auto& arms = c_.stars[node].arms;
    for (int arm = 0; arm < static_cast<int>(arms.size()); ++arm)
      if (!w_.arcs[arcOf(arms[arm])].collapsed) result.emplace_back(node, arm);
  }
  return result;
}

}  // namespace sweepface::codec
