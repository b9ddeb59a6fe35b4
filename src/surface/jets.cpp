#include "surface/jets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ode/elementary.hpp"
#include "ode/power.hpp"
#include "surface/basis_table.hpp"
#include "surface/chart.hpp"

namespace sweepface {

namespace {

constexpr int comp(int i, int j) { return 3 * i + j; }
double signOf(int power) { return power % 2 ? -1 : 1; }

// By quarter and component.
struct Turn {
  signed char component, sign;
};
constexpr auto kTurns = [] {
  std::array<std::array<Turn, 9>, 4> all{};
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int flips = (quarter == 1 || quarter == 2 ? j : 0) + (quarter >= 2 ? i : 0);
        all[quarter][comp(i, j)] = {static_cast<signed char>(quarter % 2 ? comp(j, i) : comp(i, j)),
                                    static_cast<signed char>(flips % 2 ? -1 : 1)};
      }
  return all;
}();

}  // namespace

Turned turned(int quarter, int i, int j) {
  const auto [component, sign] = kTurns[quarter][comp(i, j)];
  return {component, static_cast<double>(sign)};
}

namespace {

// The derived vectors' sums of terms, written one after the other into one list.
class Rows {
 public:
  void resize(std::size_t vectors) {
    ranges_.resize(vectors);
    terms_.reserve(4 * vectors);
  }

  /// What is added from here on belongs to `vector`, until it is closed.
  void open(Index vector) {
    open_ = vector;
    ranges_[vector].first = static_cast<Index>(terms_.size());
  }
  // In their order by vector; those of the same one are added up. Rows are short.
  void add(Index vector, double factor) {
    if (factor == 0) return;
    const auto first = terms_.begin() + ranges_[open_].first;
    auto place = terms_.end();
    while (place != first && place[-1].vector >= vector) --place;
    if (place != terms_.end() && place->vector == vector)
      place->factor += factor;
    else
      terms_.insert(place, {vector, factor});
  }
  /// Drops what has no factor.
  void close() {
    auto& [first, end] = ranges_[open_];
    end = first;
    for (auto t = terms_.begin() + first; t != terms_.end(); ++t)
      if (t->factor != 0) terms_[end++] = *t;
    terms_.resize(end);
  }

  std::span<const Term> of(Index vector) const {
    const auto [first, end] = ranges_[vector];
    return {terms_.data() + first, terms_.data() + end};
  }
  std::size_t termCount() const { return terms_.size(); }

 private:
  struct Range {
    Index first = 0, end = 0;
  };

  std::vector<Range> ranges_;  // [vectors]
  std::vector<Term> terms_;
  Index open_ = -1;
};

// Which derived vectors need a derived vector, in ascending order.
class Dependents {
 public:
  Dependents(const Rows& rows, const std::vector<char>& isStored)
      : starts_(isStored.size() + 1, 0), needs_(isStored.size(), 0) {
    const auto vectors = static_cast<Index>(isStored.size());
    const auto eachNeed = [&](const auto& use) {
      for (Index v = 0; v < vectors; ++v)
        for (const Term& t : rows.of(v))
          if (!isStored[t.vector]) use(t.vector, v);
    };
    eachNeed([&](Index needed, Index v) { ++starts_[needed + 1], ++needs_[v]; });
    for (Index v = 0; v < vectors; ++v) starts_[v + 1] += starts_[v];
    all_.resize(starts_.back());
    std::vector<Index> next(starts_.begin(), starts_.end() - 1);
    eachNeed([&](Index needed, Index v) { all_[next[needed]++] = v; });
  }

  std::span<const Index> of(Index vector) const {
    return {all_.data() + starts_[vector], all_.data() + starts_[vector + 1]};
  }
  /// [vectors] how many derived vectors each needs.
  const std::vector<Index>& needs() const { return needs_; }

 private:
  std::vector<Index> starts_, needs_, all_;
};

}  // namespace

// Numbers all vectors first, so that rows may refer to each other in any order, then writes the
// rows and puts them into an order in which each needs only earlier ones.
class JetBuilder {
 public:
  JetBuilder(const Wireframe& w, const Connectivity& c, const BasisTable& bases)
      : w_(w), c_(c), bases_(bases) {}

  Result<JetTable> build(std::vector<Index>* circle) {
    number();
    for (Index n = 0; n < nodeCount(); ++n) {
      if (c_.kinds[n] == NodeKind::crossing) predict(n);
      if (c_.kinds[n] == NodeKind::hanging) hang(n);
    }
    for (const Hub& hub : hubs_)
      if (hub.first >= 0) chart(hub);
    for (Index n = 0; n < nodeCount(); ++n)
      if (c_.kinds[n] == NodeKind::creased) foldFans(n);
    return order(circle);
  }

 private:
  // The vectors of an irregular point and the ring of sectors around it.
  struct Hub {
    Index first = -1;          // of its six vectors: p, A, B and the second derivatives C, D, E
    std::vector<Index> nodes;  // in the order of the ring; several only around collapsed arcs
  };
  using Owner = StoredVector;
  // The vectors A, B, C, D, E of F(x, y) = p + A x + B y + ½(C x² + 2 D x y + E y²).
  using Quadratic = std::array<Index, 5>;
  static Quadratic quadratic(const Hub& hub) {
    return {hub.first + 1, hub.first + 2, hub.first + 3, hub.first + 4, hub.first + 5};
  }

  Index nodeCount() const { return static_cast<Index>(w_.nodes.size()); }
  Index vectorCount() const { return static_cast<Index>(owners_.size()); }
  Index add(Owner owner, bool stored) {
    owners_.push_back(owner);
    isStored_.push_back(stored);
    return vectorCount() - 1;
  }

  // No fewer than there will be.
  std::size_t mostVectors() const {
    std::size_t count = 9 * w_.nodes.size();
    for (Index n = 0; n < nodeCount(); ++n)
      if (c_.kinds[n] == NodeKind::irregular || c_.kinds[n] == NodeKind::creased)
        count +=
            8 * c_.fans[n].size() + 2 * c_.stars[n].arms.size() + 4 * c_.stars[n].sectors.size();
    return count;
  }

  void number() {
    owners_.reserve(mostVectors());
    isStored_.reserve(owners_.capacity());
    base_.assign(nodeCount(), -1);
    hubs_.resize(w_.points);
    armBase_.assign(nodeCount(), -1);
    fanBase_.assign(nodeCount(), -1);
    mixedBase_.assign(4 * w_.patches.size(), -1);
    for (Index n = 0; n < nodeCount(); ++n) {
      if (c_.kinds[n] == NodeKind::irregular) {
        numberIrregular(n);
        continue;
      }
      if (c_.kinds[n] == NodeKind::creased) {
        numberCreased(n);
        continue;
      }
      const bool crossing = c_.kinds[n] == NodeKind::crossing;
      base_[n] = vectorCount();
      for (int k = 0; k < 9; ++k)
        add({n, k / 3, k % 3}, crossing && (k == 0 || (w_.nodes[n].stored >> k & 1)));
    }
    rows_.resize(owners_.size());
  }

  void numberIrregular(Index n) {
    Hub& hub = hubs_[w_.nodes[n].point];
    if (hub.first < 0) {
      constexpr int kOrders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
      hub.first = vectorCount();
      for (auto [i, j] : kOrders) add({n, i, j}, true);
    }
    hub.nodes.push_back(n);
    numberArms(n);
  }

  // Nodes without axes of their own have vectors by arm and by corner.
  void numberArms(Index n) {
    const Star& star = c_.stars[n];
    armBase_[n] = vectorCount();
    for (std::size_t k = 0; k < 2 * star.arms.size(); ++k) add({n, 0, 0}, false);
    for (Index corner : star.sectors) {
      mixedBase_[corner] = vectorCount();
      for (int k = 0; k < 4; ++k) add({n, 0, 0}, false);
    }
  }

  void numberCreased(Index n) {
    base_[n] = add({n, 0, 0}, true);
    fanBase_[n] = vectorCount();
    const auto& fans = c_.fans[n];
    for (int f = 0; f < static_cast<int>(fans.size()); ++f)
      for (int k = 1; k < 9; ++k) add({n, k / 3, k % 3, f}, fanStores(fans[f], k));
    numberArms(n);
  }

  // What a fan has of its own: what its neighbours do not give, up to the second order in a chart.
  static bool fanStores(const Fan& fan, int k) {
    if (!fan.regular && (k == 5 || k >= 7)) return false;
    if (fan.firstGiven && (k == 3 || k == 6)) return false;
    const bool lastIsY =
        fan.regular ? fan.sectors == 1 : std::abs(ode::sineCosine(opening(fan)).sine) > 1e-9;
    return !(fan.lastGiven && lastIsY && (k == 1 || k == 2));
  }
  static double opening(const Fan& fan) { return fan.step * fan.sectors; }

  // Whether all corners of a node share nine vectors.
  bool hasAxes(Index n) const {
    return c_.kinds[n] == NodeKind::crossing || c_.kinds[n] == NodeKind::hanging;
  }

  // How a corner of such a node is turned from its axes.
  int quarterOf(Index corner) const {
    const Index n = c_.cornerNode[corner];
    const int sector = c_.cornerSector[corner];
    return c_.kinds[n] == NodeKind::hanging ? (sector - hostArm(n) + 3) % 3 : sector;
  }

  // ∂α^i ∂β^j in axes turned from those of the node.
  JetRef nodeJet(Index n, int quarter, int i, int j) const {
    const auto [component, sign] = kTurns[quarter][comp(i, j)];
    return {base_[n] + component, static_cast<double>(sign)};
  }

  // ∂α^i ∂β^j at a corner.
  JetRef cornerJet(Index corner, int i, int j) const {
    const Index n = c_.cornerNode[corner];
    if (!hasAxes(n)) {
      const bool creased = c_.kinds[n] == NodeKind::creased;
      if (i == 0 && j == 0) return {creased ? base_[n] : hubs_[w_.nodes[n].point].first, 1};
      const int sector = c_.cornerSector[corner], arms = static_cast<int>(c_.stars[n].arms.size());
      if (j == 0) return {armBase_[n] + 2 * sector + i - 1, 1};
      if (i == 0) return {armBase_[n] + 2 * ((sector + 1) % arms) + j - 1, 1};
      return {mixedBase_[corner] + 2 * (i - 1) + j - 1, 1};
    }
    return nodeJet(n, quarterOf(corner), i, j);
  }

  // The arm of a T-node along which its own x axis runs: the stem follows counter-clockwise.
  int hostArm(Index n) const {
    const Star& star = c_.stars[n];
    const auto straight = std::find(star.sectors.begin(), star.sectors.end(), kStraight);
    return static_cast<int>(straight - star.sectors.begin() + 1) % 3;
  }

  // A T-node hangs on a rail: its jet is that of the rail's curve and cross-derivative curves,
  // which the sub-patches' own curves continue because ρ, η, λ are given per unit length.
  void hang(Index n) {
    const int host = hostArm(n);
    const Star& star = c_.stars[n];
    const Rail ahead = c_.rails[star.arms[host]];
    const Rail behind = c_.rails[star.arms[(host + 2) % 3]];
    const Index endCorner = c_.cornerAt[c_.next[ahead.last]];
    const Index startCorner = c_.cornerAt[twin(behind.last)];
    const int length = ahead.edges + behind.edges;
    const SweepBasis& g = bases_.at(w_.arcs[arcOf(star.arms[host])].ribbon, length);
    for (int i = 0; i < 3; ++i) {
      const auto value = g.at(static_cast<double>(behind.edges) / length, i);
      for (int j = 0; j < 3; ++j) {
        rows_.open(base_[n] + comp(i, j));
        for (int a = 0; a < 3; ++a) {
          const double scale = ode::power(length, a - i);
          addJet(cornerJet(startCorner, a, j), value[a] * scale);
          addJet(cornerJet(endCorner, j, a), value[3 + a] * scale * signOf(a));
        }
        rows_.close();
      }
    }
  }

  // ∂^j across a line at a node: what one patch beside it knows, or the mean of two.
  struct Across {
    std::array<Term, 2> terms;
    int count = 0;
  };

  // To the left of travel, at the node where a rail arrives. Patches on both sides differ only at
  // irregular nodes.
  Across acrossAtEnd(const Rail& rail, int j) const {
    Across across;
    const auto add = [&](JetRef ref, double factor) {
      across.terms[across.count++] = {ref.vector, ref.sign * factor};
    };
    const Index left = c_.patchOf[rail.last] < 0 ? -1 : c_.cornerAt[c_.next[rail.last]];
    const Index right = c_.patchOf[twin(rail.last)] < 0 ? -1 : c_.cornerAt[twin(rail.last)];
    const double share = left >= 0 && right >= 0 ? 0.5 : 1;
    if (left >= 0) add(cornerJet(left, j, 0), share);
    if (right >= 0) add(cornerJet(right, 0, j), share * signOf(j));
    return across;
  }

  // Values of ∂^other across the line through node n along axis d, at its two neighbours.
  struct Neighbours {
    bool has[2] = {false, false};
    double distance[2] = {0, 0};
    Across value[2];
  };
  Neighbours neighbours(Index n, int d, int other) const {
    Neighbours result;
    const Star& star = c_.stars[n];
    for (int e = 0; e < 2; ++e) {
      const std::size_t arm = d + 2 * e;
      if (arm >= star.arms.size()) continue;
      const Rail rail = c_.rails[star.arms[arm]];
      result.has[e] = true;
      result.distance[e] = rail.edges;
      result.value[e] = acrossAtEnd(rail, other);
      if ((d == 0) == (e == 1))  // the other axis points to the right of travel
        for (Term& t : result.value[e].terms) t.factor *= signOf(other);
    }
    return result;
  }

  void predict(Index n) {
    for (int k = 1; k < 9; ++k)
      if (!isStored_[base_[n] + k]) predictComponent(n, k / 3, k % 3);
  }

  // A component that is not stored follows from the polynomial along one line through the node that
  // takes the values of the neighbours and what the node itself stores.
  void predictComponent(Index n, int i, int j) {
    const auto known = [&](int a, int b) {
      return a < 3 && b < 3 && isStored_[base_[n] + comp(a, b)];
    };
    int alongX = 0, alongY = 0;
    while (known(alongX, j)) ++alongX;
    while (known(i, alongY)) ++alongY;
    const int d = alongX >= alongY && (alongX > 0 || i > 0) ? 0 : 1;
    const int order = d == 0 ? i : j, other = d == 0 ? j : i;
    const int count = std::max(1, d == 0 ? alongX : alongY);
    const auto own = [&](int a) { return base_[n] + (d == 0 ? comp(a, other) : comp(other, a)); };
    const Neighbours at = neighbours(n, d, other);
    rows_.open(base_[n] + comp(i, j));
    if (count == 1)
      predictFromValues(at, own(0), order);
    else
      predictFromSlope(at, own(0), own(1));
    rows_.close();
  }

  // Derivative 1 or 2 of the parabola through the node and its neighbours.
  void predictFromValues(const Neighbours& at, Index own, int order) {
    if (!at.has[0] || !at.has[1]) {  // the end of a line: a straight one
      if (order == 1)
        for (int e = 0; e < 2; ++e)
          if (at.has[e]) {
            const double s = (e == 0 ? 1 : -1) / at.distance[e];
            addAll(at.value[e], s);
            rows_.add(own, -s);
          }
      return;
    }
    const double a = at.distance[0], b = at.distance[1];
    const double s = (order == 1 ? 1 : 2) / (a * b * (a + b));
    addAll(at.value[0], order == 1 ? b * b * s : b * s);
    addAll(at.value[1], order == 1 ? -a * a * s : a * s);
    rows_.add(own, order == 1 ? (a * a - b * b) * s : -(a + b) * s);
  }

  // Second derivative of the cubic through the neighbours that has the node's value and slope; at
  // the end of a line, of the parabola through its one neighbour.
  void predictFromSlope(const Neighbours& at, Index own, Index slope) {
    for (int e = 0; e < 2; ++e) {
      if (!at.has[e]) continue;
      const double h = at.distance[e], outward = e == 0 ? 1 : -1;
      const double weight = at.has[1 - e] ? at.distance[1 - e] / (h + at.distance[1 - e]) : 1;
      const double s = 2 * weight / (h * h);
      addAll(at.value[e], s);
      rows_.add(own, -s);
      rows_.add(slope, -outward * h * s);
    }
  }

  // The surface near an irregular point is F(x, y) = p + A x + B y + ½(C x² + 2 D x y + E y²) over
  // the chart; the patches' corners are the jets of F composed with the chart's corner maps.
  void chart(const Hub& hub) {
    const std::vector<Index> ring = orderRing(hub);
    int steps = 0;
    double logLength = 0;
    int spokes = 0;
    for (Index n : ring)
      for (std::size_t s = 0; s < c_.stars[n].arms.size(); ++s) {
        const HalfArc arm = c_.stars[n].arms[s];
        const Arc& arc = w_.arcs[arcOf(arm)];
        if (!arc.collapsed) {
          logLength += ode::logarithm(c_.rails[arm].edges);
          ++spokes;
        }
      }
    for (Index n : ring) {
      const Star& star = c_.stars[n];
      for (std::size_t s = 0; s < star.sectors.size(); ++s)
        if (!collapsedArm(n, s) && !collapsedArm(n, s + 1)) ++steps;
      if (!star.closed && collapsedArm(n, star.arms.size() - 1)) steps += lastEdges(n);
    }
    const bool open = !c_.stars[ring[0]].closed && !collapsedArm(ring[0], 0);
    const double step = (open ? 1 : 2) * std::numbers::pi / steps;
    const double scale = std::max(1.0, 0.25 * ode::exponential(logLength / std::max(1, spokes)));
    double angle = 0;
    for (Index n : ring) angle = chartNode(hub, n, angle, step, scale);
  }

  bool collapsedArm(Index n, std::size_t arm) const {
    const Star& star = c_.stars[n];
    return w_.arcs[arcOf(star.arms[arm % star.arms.size()])].collapsed;
  }
  Index lastEdges(Index n) const { return w_.arcs[arcOf(c_.stars[n].arms.back())].edges; }

  // Around a pole the nodes follow each other counter-clockwise across collapsed arcs.
  std::vector<Index> orderRing(const Hub& hub) const {
    Index first = hub.nodes[0];
    for (Index n : hub.nodes)
      if (!c_.stars[n].closed && !collapsedArm(n, 0)) first = n;
    std::vector<Index> ring;
    for (Index n = first; ring.size() < hub.nodes.size();) {
      ring.push_back(n);
      const HalfArc last = c_.stars[n].arms.back();
      if (c_.stars[n].closed || !w_.arcs[arcOf(last)].collapsed) break;
      n = w_.end(last);
      if (n == first) break;
    }
    return ring;
  }

  // Writes the rows of one node of a hub whose first real spoke stands at `angle`; returns the
  // angle of the next node's.
  double chartNode(const Hub& hub, Index n, double angle, double step, double scale) {
    const Star& star = c_.stars[n];
    for (std::size_t s = 0; s < star.sectors.size(); ++s) {
      const bool first = collapsedArm(n, s), second = collapsedArm(n, s + 1);
      PlaneJet jet;
      if (first)
        jet = collapsedCorner(angle, -step, true);
      else if (second)
        jet = collapsedCorner(angle, step, false);
      else
        jet = characteristicCorner(angle, step, scale);
      if (!first) writeSpoke(hub, n, s, angle, step, scale, first || second);
      for (int k = 0; k < 4; ++k)
        compose(mixedBase_[star.sectors[s]] + k, quadratic(hub), jet, 1 + k / 2, 1 + k % 2);
      if (!first && !second) angle += step;
    }
    if (star.closed) return angle;
    const std::size_t last = star.arms.size() - 1;
    if (!collapsedArm(n, last)) writeSpoke(hub, n, last, angle, step, scale, false);
    return collapsedArm(n, last) ? angle + step * lastEdges(n) : angle;
  }

  void writeSpoke(const Hub& hub, Index n, std::size_t arm, double angle, double step, double scale,
                  bool ray) {
    ray = ray || (arm > 0 && collapsedArm(n, arm - 1));
    const auto d = ray ? std::array<std::complex<double>, 2>{onCircle(angle), 0}
                       : characteristicSpoke(angle, step, scale);
    composeArm(n, arm, quadratic(hub), d);
  }

  void composeArm(Index n, std::size_t arm, const Quadratic& f,
                  const std::array<std::complex<double>, 2>& d) {
    PlaneJet along{};
    along[comp(1, 0)] = d[0];
    along[comp(2, 0)] = d[1];
    for (int i = 1; i <= 2; ++i) compose(armVector(n, arm, i), f, along, i, 0);
  }
  Index armVector(Index n, std::size_t arm, int i) const {
    return armBase_[n] + 2 * static_cast<Index>(arm % c_.stars[n].arms.size()) + i - 1;
  }

  // ∂α^i ∂β^j of F(φ(α, β)) by Leibniz' rule.
  void compose(Index vector, const Quadratic& f, const PlaneJet& jet, int i, int j) {
    constexpr double kBinomial[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 1}};
    double xx = 0, xy = 0, yy = 0;
    for (int a = 0; a <= i; ++a)
      for (int b = 0; b <= j; ++b) {
        const auto p = jet[comp(a, b)], q = jet[comp(i - a, j - b)];
        const double k = kBinomial[i][a] * kBinomial[j][b];
        xx += k * p.real() * q.real();
        xy += k * p.real() * q.imag();
        yy += k * p.imag() * q.imag();
      }
    const auto d = jet[comp(i, j)];
    const double factors[5] = {d.real(), d.imag(), xx / 2, xy, yy / 2};
    rows_.open(vector);
    for (int k = 0; k < 5; ++k)  // what is rounding only must not tie patches together
      if (std::abs(factors[k]) > 1e-14) rows_.add(f[k], factors[k]);
    rows_.close();
  }

  // A creased node: every fan has its jet, and takes from the fans before it what they share.
  void foldFans(Index n) {
    const auto& arms = c_.stars[n].arms;
    double logLength = 0;
    for (HalfArc arm : arms) logLength += ode::logarithm(c_.rails[arm].edges);
    const double scale =
        std::max(1.0, 0.25 * ode::exponential(logLength / static_cast<double>(arms.size())));
    for (std::size_t f = 0; f < c_.fans[n].size(); ++f)
      c_.fans[n][f].regular ? foldRegular(n, f) : foldChart(n, f, scale);
  }

  Index fanVector(Index n, std::size_t fan, int i, int j) const {
    return fanBase_[n] + 8 * static_cast<Index>(fan) + comp(i, j) - 1;
  }

  // One jet in axes that turn with the sectors.
  void foldRegular(Index n, std::size_t f) {
    const Fan& fan = c_.fans[n][f];
    const auto own = [&](int quarter, int i, int j) {
      const Turned t = turned(quarter, i, j);
      return JetRef{fanVector(n, f, t.component / 3, t.component % 3), t.sign};
    };
    for (int i = 1; i <= 2; ++i) {
      if (fan.firstGiven) follow(fanVector(n, f, i, 0), {armVector(n, fan.first, i), 1});
      if (fan.lastGiven && fan.sectors == 1)
        follow(fanVector(n, f, 0, i), {armVector(n, fan.first + 1, i), 1});
    }
    for (int k = 0; k <= fan.sectors; ++k) {
      const bool given = k == 0 ? fan.firstGiven : k == fan.sectors && fan.lastGiven;
      for (int i = 1; i <= 2 && !given; ++i) follow(armVector(n, fan.first + k, i), own(k, i, 0));
      for (int m = 0; m < 4 && k < fan.sectors; ++m)
        follow(mixedBase_[sector(n, fan.first + k)] + m, own(k, 1 + m / 2, 1 + m % 2));
    }
  }
  Index sector(Index n, int k) const {
    const auto& sectors = c_.stars[n].sectors;
    return sectors[static_cast<std::size_t>(k) % sectors.size()];
  }

  // A second-order jet in a chart of the fan, as around an irregular point.
  void foldChart(Index n, std::size_t f, double scale) {
    const Fan& fan = c_.fans[n][f];
    const Quadratic own{fanVector(n, f, 1, 0), fanVector(n, f, 0, 1), fanVector(n, f, 2, 0),
                        fanVector(n, f, 1, 1), fanVector(n, f, 0, 2)};
    solveGiven(n, f, scale);
    for (int k = 0; k <= fan.sectors; ++k) {
      const double angle = k * fan.step;
      const bool given = k == 0 ? fan.firstGiven : k == fan.sectors && fan.lastGiven;
      if (!given) composeArm(n, fan.first + k, own, characteristicSpoke(angle, fan.step, scale));
      if (k == fan.sectors) break;
      const PlaneJet jet = characteristicCorner(angle, fan.step, scale);
      for (int m = 0; m < 4; ++m)
        compose(mixedBase_[sector(n, fan.first + k)] + m, own, jet, 1 + m / 2, 1 + m % 2);
    }
  }

  // A, C from the derivatives s A, s² C + t A along the first arm; B, E from those along the last
  // at its angle, unless it runs straight on from the first.
  void solveGiven(Index n, std::size_t f, double scale) {
    const Fan& fan = c_.fans[n][f];
    const auto spoke = characteristicSpoke(0, fan.step, scale);
    const double s = spoke[0].real(), t = spoke[1].real();
    const auto own = [&](int i, int j) { return fanVector(n, f, i, j); };
    const auto open = [&](int i, int j) { rows_.open(own(i, j)); };
    if (fan.firstGiven) {
      open(1, 0);
      rows_.add(armVector(n, fan.first, 1), 1 / s);
      rows_.close();
      open(2, 0);
      rows_.add(armVector(n, fan.first, 2), 1 / (s * s));
      rows_.add(own(1, 0), -t / (s * s));
      rows_.close();
    }
    const auto [d, c] = ode::sineCosine(opening(fan));
    if (!fan.lastGiven || std::abs(d) <= 1e-9) return;
    const std::size_t last = fan.first + fan.sectors;
    open(0, 1);
    rows_.add(armVector(n, last, 1), 1 / (s * d));
    rows_.add(own(1, 0), -c / d);
    rows_.close();
    const double e = 1 / (s * s * d * d);
    open(0, 2);
    rows_.add(armVector(n, last, 2), e);
    rows_.add(own(2, 0), -c * c / (d * d));
    rows_.add(own(1, 1), -2 * c / d);
    rows_.add(own(1, 0), -t * c * e);
    rows_.add(own(0, 1), -t * d * e);
    rows_.close();
  }

  // A vector that is another one.
  void follow(Index vector, JetRef other) {
    rows_.open(vector);
    addJet(other, 1);
    rows_.close();
  }
  void addJet(JetRef ref, double factor) { rows_.add(ref.vector, ref.sign * factor); }
  void addAll(const Across& across, double factor) {
    for (int k = 0; k < across.count; ++k)
      rows_.add(across.terms[k].vector, across.terms[k].factor * factor);
  }

  // Kahn's algorithm: stored vectors first, then derived ones as soon as all they need is there.
  Result<JetTable> order(std::vector<Index>* circle) const {
    std::vector<Index> place(owners_.size(), -1);
    JetTable table;
    for (Index v = 0; v < vectorCount(); ++v)
      if (isStored_[v]) {
        place[v] = static_cast<Index>(table.stored.size());
        table.stored.push_back(owners_[v]);
      }
    const Dependents dependents(rows_, isStored_);
    std::vector<Index> waitsFor = dependents.needs(), ready;
    ready.reserve(owners_.size() - table.stored.size());
    for (Index v = 0; v < vectorCount(); ++v)
      if (!isStored_[v] && waitsFor[v] == 0) ready.push_back(v);
    table.terms.reserve(rows_.termCount());
    table.rowStart.reserve(ready.capacity() + 1);
    for (std::size_t k = 0; k < ready.size(); ++k) {
      const Index v = ready[k];
      place[v] = static_cast<Index>(table.stored.size() + k);
      for (const Term& t : rows_.of(v)) table.terms.push_back({place[t.vector], t.factor});
      table.rowStart.push_back(static_cast<Index>(table.terms.size()));
      for (Index d : dependents.of(v))
        if (--waitsFor[d] == 0) ready.push_back(d);
    }
    if (table.stored.size() + ready.size() < owners_.size()) return circular(place, circle);
    fillCorners(table, place);
    return table;
  }

  // Follows unmet needs until they repeat. Every circle that is met names one node which could
  // break it: one that predicts if there is any, else a T-node.
  Result<JetTable> circular(const std::vector<Index>& place, std::vector<Index>* circle) const {
    std::vector<Index> seenFrom(place.size(), -1);
    std::vector<Index> found;
    for (Index start = 0; start < static_cast<Index>(place.size()); ++start) {
      Index v = start;
      while (place[v] < 0 && seenFrom[v] < 0) {
        seenFrom[v] = start;
        v = unmet(v, place);
      }
      if (place[v] < 0 && seenFrom[v] == start) found.push_back(breaker(v, place));
    }
    if (circle) *circle = found;
    return fail("the derivatives at node ", found.front(),
                " are derived from themselves; let it store its own");
  }
  Index unmet(Index v, const std::vector<Index>& place) const {
    const auto row = rows_.of(v);
    return std::find_if(row.begin(), row.end(), [&](const Term& t) { return place[t.vector] < 0; })
        ->vector;
  }
  Index breaker(Index first, const std::vector<Index>& place) const {
    Index v = first;
    do {
      if (c_.kinds[owners_[v].node] == NodeKind::crossing) break;
      v = unmet(v, place);
    } while (v != first);
    return owners_[v].node;
  }

  void fillCorners(JetTable& table, const std::vector<Index>& place) const {
    table.corners.reserve(36 * w_.patches.size());
    for (Index corner = 0; corner < static_cast<Index>(4 * w_.patches.size()); ++corner) {
      const Index n = c_.cornerNode[corner];
      const int quarter = hasAxes(n) ? quarterOf(corner) : -1;
      for (int k = 0; k < 9; ++k) {
        JetRef ref =
            quarter < 0 ? cornerJet(corner, k / 3, k % 3) : nodeJet(n, quarter, k / 3, k % 3);
        ref.vector = place[ref.vector];
        table.corners.push_back(ref);
      }
    }
  }

  const Wireframe& w_;
  const Connectivity& c_;
  const BasisTable& bases_;
  Rows rows_;
  std::vector<char> isStored_;    // [vectors]
  std::vector<Owner> owners_;     // [vectors]
  std::vector<Index> base_;       // [nodes] first of nine vectors of a crossing or a T-node
  std::vector<Index> armBase_;    // [nodes] first of two vectors an arm of an irregular node
  std::vector<Index> mixedBase_;  // [corners] first of four mixed vectors at an irregular node
  std::vector<Index> fanBase_;    // [nodes] first of eight vectors a fan of a creased node
  std::vector<Hub> hubs_;         // [points]
};

Result<JetTable> buildJets(const Wireframe& wireframe, const Connectivity& connectivity,
                           const BasisTable& bases, std::vector<Index>* circle) {
  return JetBuilder(wireframe, connectivity, bases).build(circle);
}

}  // namespace sweepface
