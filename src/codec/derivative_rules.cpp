#include "codec/derivative_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sweepface::codec {

HalfArc oppositeOf(const Wireframe& w, const Connectivity& c, HalfArc h) {
  const Index node = w.start(h);
  const auto& arms = c.stars[node].arms;
  const auto arm = std::ranges::find(arms, h) - arms.begin();
  const int on = c.opposite(node, static_cast<int>(arm));
  return on < 0 ? -1 : arms[on];
}

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

DerivativeRules::Neighbour DerivativeRules::neighbour(Index node, int arm) const {
  Neighbour n;
  const Star& star = c_.stars[node];
  if (arm >= static_cast<int>(star.arms.size())) return n;
  const Rail& rail = c_.rails[star.arms[arm]];
  n.distance = rail.edges;
  n.back = twin(rail.last);
  n.node = w_.start(n.back);
  n.has = placeAll(n.node, n.value);
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
  const HalfArc back = oppositeOf(w_, c_, h);
  if (back < 0) return false;
  const Rail &ahead = c_.rails[h], &behind = c_.rails[back];
  if (!isSite(w_.end(ahead.last)) || !isSite(w_.end(behind.last))) return false;
  const double a = ahead.edges, b = behind.edges, s = 1 / (a * b * (a + b));
  terms.push_back({position(w_.end(ahead.last)), b * b * s});
  terms.push_back({position(w_.end(behind.last)), -a * a * s});
  terms.push_back({position(node), (a * a - b * b) * s});
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

void DerivativeRules::along(const std::array<Neighbour, 2>& at, Index own, Index slope, int order,
                            Terms& terms) const {
  if (slope >= 0) {
    for (int e = 0; e < 2; ++e) {
      if (!at[e].has) continue;
      const double h = at[e].distance, outward = e == 0 ? 1 : -1;
      const double weight = at[1 - e].has ? at[1 - e].distance / (h + at[1 - e].distance) : 1;
      const double s = 2 * weight / (h * h);
      addTerms(terms, at[e].value, s);
      terms.push_back({own, -s});
      terms.push_back({slope, -outward * h * s});
    }
    return;
  }
  if (!at[0].has || !at[1].has) {
    if (order == 1)
      for (int e = 0; e < 2; ++e)
        if (at[e].has) {
          const double s = (e == 0 ? 1 : -1) / at[e].distance;
          addTerms(terms, at[e].value, s);
          terms.push_back({own, -s});
        }
    return;
  }
  const double a = at[0].distance, b = at[1].distance;
  const double s = (order == 1 ? 1 : 2) / (a * b * (a + b));
  addTerms(terms, at[0].value, order == 1 ? b * b * s : b * s);
  addTerms(terms, at[1].value, order == 1 ? -a * a * s : a * s);
  terms.push_back({own, order == 1 ? (a * a - b * b) * s : -(a + b) * s});
}

void DerivativeRules::mixed(Index node, Terms& terms) const {
  std::array<FewTerms, 2> change;
  int known = 0;
  for (int d = 0; d < 2; ++d) known += changeAcross(node, neighbours(node, 1 - d), d, change[d]);
  for (const FewTerms& t : change) addTerms(terms, t, 1.0 / std::max(1, known));
}

bool DerivativeRules::changeAcross(Index node, const std::array<Neighbour, 2>& at, int d,
                                   FewTerms& terms) const {
  const Index own = derivative(node, d == 0, d == 1);
  if (own < 0) return false;
  std::array<FewTerms, 2> across;
  std::array<bool, 2> has{};
  for (int e = 0; e < 2; ++e)
    has[e] = at[e].has && isSite(at[e].node) && slopeAcross(at[e], (d == 0) == (e == 0), across[e]);
  if (has[0] && has[1]) {
    const double a = at[0].distance, b = at[1].distance, s = 1 / (a * b * (a + b));
    addTerms(terms, across[0], b * b * s);
    addTerms(terms, across[1], -a * a * s);
    terms.push_back({own, (a * a - b * b) * s});
    return true;
  }
  for (int e = 0; e < 2; ++e)
    if (has[e]) {
      const double s = (e == 0 ? 1 : -1) / at[e].distance;
      addTerms(terms, across[e], s);
      terms.push_back({own, -s});
      return true;
    }
  return false;
}

bool DerivativeRules::slopeAcross(const Neighbour& n, bool right, FewTerms& terms) const {
  if (c_.kinds[n.node] != NodeKind::crossing || !c_.stars[n.node].closed) return false;
  const auto& arms = c_.stars[n.node].arms;
  if (arms.size() != 4) return false;
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
    const Neighbour n = neighbour(node, arm);
    if (!n.has) continue;
    double a = 0, b = 0;
    for (const Term& t : surface_.derivation(surface_.alongJet(h, 1).vector)) {
      const double rounded = std::round(t.factor * 1048576) / 1048576;
      if (t.vector == site.first + 1) a = rounded;
      if (t.vector == site.first + 2) b = rounded;
    }
    xx += a * a, xy += a * b, yy += b * b;
    const double out = 1 / n.distance;
    addTerms(x, n.value, a * out), x.push_back({site.first, -a * out});
    addTerms(y, n.value, b * out), y.push_back({site.first, -b * out});
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
