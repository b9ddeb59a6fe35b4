#include "surface/line_jets.hpp"

#include <algorithm>

#include "ode/power.hpp"
#include "surface/line_prediction.hpp"

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
    const auto at = neighbours(n, d, other);
    const auto add = [&](const Across& value, double factor) { value.addTo(rows_, factor); };
    const auto addOwn = [&](int a) {
      return [this, vector = own(a)](double factor) { rows_.add(vector, factor); };
    };
    rows_.open(numbers_.own(n, i, j));
    if (count == 1)
      derivativeFromValues(at, order, add, addOwn(0));
    else
      derivativeFromSlope(at, add, addOwn(0), addOwn(1));
    rows_.close();
  }

  // Values of ∂^other across the line through a node along one of its axes.
  LineNeighbours<Across> neighbours(Index n, int d, int other) const {
    LineNeighbours<Across> result;
    const Star& star = c_.stars[n];
    for (int e = 0; e < 2; ++e) {
      const std::size_t arm = d + 2 * e;
      if (arm >= star.arms.size()) continue;
      const Rail rail = c_.rails[star.arms[arm]];
      result[e] = {static_cast<double>(rail.edges), acrossAtEnd(rail, other)};
      if ((d == 0) == (e == 1))  // the other axis points to the right of travel
        for (Term& t : result[e].value.terms) t.factor *= signOf(other);
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
