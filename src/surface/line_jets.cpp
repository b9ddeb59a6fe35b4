#include "surface/line_jets.hpp"

#include <algorithm>

#include "ode/power.hpp"

namespace sweepface {

namespace {

double signOf(int power) { return power % 2 ? -1 : 1; }

// ∂^j across a line at a node: that of the one patch beside it, or the mean of two.
struct Across {
  std::array<Term, 2> terms;
  int count = 0;

  void add(JetRef ref, double factor) { terms[count++] = {ref.vector, ref.sign * factor}; }
  void addTo(JetRows& rows, double factor) const {
    for (int k = 0; k < count; ++k) rows.add(terms[k].vector, terms[k].factor * factor);
  }
};

// Values of ∂^other across the line through a node along one of its axes, at its two neighbours.
struct Neighbours {
  bool has[2] = {false, false};
  double distance[2] = {0, 0};
  Across value[2];
};

class Predictor {
 public:
  Predictor(const Connectivity& connectivity, const JetNumbers& numbers, JetRows& rows)
      : c_(connectivity), numbers_(numbers), rows_(rows) {}

  void predict(Index n) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (!numbers_.isStored(numbers_.own(n, i, j))) predictComponent(n, i, j);
  }

 private:
  void predictComponent(Index n, int i, int j) {
    const auto known = [&](int a, int b) {
      return a < 3 && b < 3 && numbers_.isStored(numbers_.own(n, a, b));
    };
    int alongX = 0, alongY = 0;
    while (known(alongX, j)) ++alongX;
    while (known(i, alongY)) ++alongY;
    const int d = alongX >= alongY ? 0 : 1;
    const int order = d == 0 ? i : j, other = d == 0 ? j : i;
    const int count = std::max(1, d == 0 ? alongX : alongY);
    const auto own = [&](int a) {
      return d == 0 ? numbers_.own(n, a, other) : numbers_.own(n, other, a);
    };
    const Neighbours at = neighbours(n, d, other);
    rows_.open(numbers_.own(n, i, j));
    if (count == 1)
      predictFromValues(at, own(0), order);
    else
      predictFromSlope(at, own(0), own(1));
    rows_.close();
  }

  // Derivative 1 or 2 of the parabola through the node and its neighbours.
  void predictFromValues(const Neighbours& at, Index own, int order) {
    if (!at.has[0] || !at.has[1]) {  // at the end of a line it is taken as straight
      if (order == 1)
        for (int e = 0; e < 2; ++e)
          if (at.has[e]) {
            const double s = (e == 0 ? 1 : -1) / at.distance[e];
            at.value[e].addTo(rows_, s);
            rows_.add(own, -s);
          }
      return;
    }
    const double a = at.distance[0], b = at.distance[1];
    const double s = (order == 1 ? 1 : 2) / (a * b * (a + b));
    at.value[0].addTo(rows_, order == 1 ? b * b * s : b * s);
    at.value[1].addTo(rows_, order == 1 ? -a * a * s : a * s);
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
      at.value[e].addTo(rows_, s);
      rows_.add(own, -s);
      rows_.add(slope, -outward * h * s);
    }
  }

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

  // ∂^j to the left of travel, at the node where a rail arrives. The patches on its two sides
  // differ only at irregular nodes.
  Across acrossAtEnd(const Rail& rail, int j) const {
    Across across;
    const Index left = c_.patchOf[rail.last] < 0 ? -1 : c_.cornerAt[c_.next[rail.last]];
    const Index right = c_.patchOf[twin(rail.last)] < 0 ? -1 : c_.cornerAt[twin(rail.last)];
    const double share = left >= 0 && right >= 0 ? 0.5 : 1;
    if (left >= 0) across.add(numbers_.atCorner(left, j, 0), share);
    if (right >= 0) across.add(numbers_.atCorner(right, 0, j), share * signOf(j));
    return across;
  }

  const Connectivity& c_;
  const JetNumbers& numbers_;
  JetRows& rows_;
};

}  // namespace

void predictCrossings(const Wireframe& wireframe, const Connectivity& connectivity,
                      const JetNumbers& numbers, JetRows& rows) {
  Predictor predictor(connectivity, numbers, rows);
  for (Index n = 0; n < static_cast<Index>(wireframe.nodes.size()); ++n)
    if (connectivity.kinds[n] == NodeKind::crossing) predictor.predict(n);
}

void hangNodes(const Wireframe& wireframe, const Connectivity& connectivity,
               const BasisTable& bases, const JetNumbers& numbers, JetRows& rows) {
  for (Index n = 0; n < static_cast<Index>(wireframe.nodes.size()); ++n) {
    if (connectivity.kinds[n] != NodeKind::hanging) continue;
    const auto [onward, back] = connectivity.stars[n].line();
    const Rail ahead = connectivity.rails[onward], behind = connectivity.rails[back];
    const auto end = numbers.atCorner(connectivity.cornerAt[connectivity.next[ahead.last]]);
    const auto start = numbers.atCorner(connectivity.cornerAt[twin(behind.last)]);
    const int length = ahead.edges + behind.edges;
    const SweepBasis& g = bases.at(wireframe.arcs[arcOf(onward)].ribbon, length);
    for (int i = 0; i < 3; ++i) {
      const auto value = g.at(static_cast<double>(behind.edges) / length, i);
      for (int j = 0; j < 3; ++j) {
        rows.open(numbers.own(n, i, j));
        for (int a = 0; a < 3; ++a) {
          const double scale = ode::power(length, a - i);
          rows.add(start[jetComponent(a, j)], value[a] * scale);
          rows.add(end[jetComponent(j, a)], value[3 + a] * scale * signOf(a));
        }
        rows.close();
      }
    }
  }
}

}  // namespace sweepface
