#include "surface/chart_jets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ode/elementary.hpp"
#include "surface/quadratic_jets.hpp"

namespace sweepface {

namespace {

// Length of the chart's unit: a quarter of the geometric mean of `arms` lengths, at least 1.
double scaleOf(double logLengths, std::size_t arms) {
  return std::max(1.0, 0.25 * ode::exponential(logLengths / static_cast<double>(arms)));
}

class HubCharts {
 public:
  HubCharts(const Wireframe& wireframe, const Connectivity& connectivity, const JetNumbers& numbers,
            JetRows& rows)
      : w_(wireframe), c_(connectivity), jets_(numbers, rows) {}

  Result<void> chart(const Hub& hub) {
    const std::vector<Index> ring = orderRing(hub);
    const int steps = stepsAround(ring);
    if (steps == 0)
      return fail("all patches at node ", hub.nodes[0], " have a side that is one point there");
    const Quadratic f{hub.first + 1, hub.first + 2, hub.first + 3, hub.first + 4, hub.first + 5};
    const bool open = !c_.stars[ring[0]].closed && !collapsedArm(ring[0], 0);
    const double step = (open ? 1 : 2) * std::numbers::pi / steps;
    const double scale = scaleAround(ring);
    double angle = 0;
    for (Index n : ring) angle = chartNode(f, n, angle, step, scale);
    return {};
  }

 private:
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

  // The number of equal angles around the ring.
  int stepsAround(const std::vector<Index>& ring) const {
    int steps = 0;
    for (Index n : ring) {
      const Star& star = c_.stars[n];
      for (std::size_t s = 0; s < star.sectors.size(); ++s)
        if (!collapsedArm(n, s) && !collapsedArm(n, s + 1)) ++steps;
      if (!star.closed && collapsedArm(n, star.arms.size() - 1)) steps += lastEdges(n);
    }
    return steps;
  }

  double scaleAround(const std::vector<Index>& ring) const {
    double logLengths = 0;
    std::size_t spokes = 0;
    for (Index n : ring)
      for (const HalfArc arm : c_.stars[n].arms)
        if (!w_.arcs[arcOf(arm)].collapsed) {
          logLengths += ode::logarithm(c_.rails[arm].edges);
          ++spokes;
        }
    return scaleOf(logLengths, std::max<std::size_t>(1, spokes));
  }

  // Writes the rows of one node of a hub whose first real spoke stands at `angle`; returns the
  // angle of the next node's first spoke.
  double chartNode(const Quadratic& f, Index n, double angle, double step, double scale) {
    const Star& star = c_.stars[n];
    for (std::size_t s = 0; s < star.sectors.size(); ++s) {
      const bool first = collapsedArm(n, s), second = collapsedArm(n, s + 1);
      const PlaneJet jet = first    ? collapsedCorner(angle, -step, true)
                           : second ? collapsedCorner(angle, step, false)
                                    : characteristicCorner(angle, step, scale);
      if (!first) writeSpoke(f, n, s, angle, step, scale, second);
      jets_.atCorner(star.sectors[s], f, jet);
      if (!first && !second) angle += step;
    }
    if (star.closed) return angle;
    const std::size_t last = star.arms.size() - 1;
    if (collapsedArm(n, last)) return angle + step * lastEdges(n);
    writeSpoke(f, n, last, angle, step, scale, false);
    return angle;
  }

  // Next to a collapsed side, spokes are straight rays.
  void writeSpoke(const Quadratic& f, Index n, std::size_t arm, double angle, double step,
                  double scale, bool ray) {
    ray = ray || (arm > 0 && collapsedArm(n, arm - 1));
    const auto d = ray ? std::array<std::complex<double>, 2>{onCircle(angle), 0}
                       : characteristicSpoke(angle, step, scale);
    jets_.alongArm(n, arm, f, d);
  }

  const Wireframe& w_;
  const Connectivity& c_;
  QuadraticJets jets_;
};

class FanCharts {
 public:
  FanCharts(const Connectivity& connectivity, const JetNumbers& numbers, JetRows& rows)
      : c_(connectivity), numbers_(numbers), rows_(rows), jets_(numbers, rows) {}

  void fold(Index n) {
    const auto& arms = c_.stars[n].arms;
    double logLengths = 0;
    for (HalfArc arm : arms) logLengths += ode::logarithm(c_.rails[arm].edges);
    const double scale = scaleOf(logLengths, arms.size());
    for (std::size_t f = 0; f < c_.fans[n].size(); ++f)
      c_.fans[n][f].regular ? foldRegular(n, f) : foldChart(n, f, scale);
  }

 private:
  Index sector(Index n, int k) const {
    const auto& sectors = c_.stars[n].sectors;
    return sectors[static_cast<std::size_t>(k) % sectors.size()];
  }

  // One jet, seen from axes that turn with the sectors.
  void foldRegular(Index n, std::size_t f) {
    const Fan& fan = c_.fans[n][f];
    const auto own = [&](int quarter, int i, int j) {
      const Turned t = turned(quarter, i, j);
      return JetRef{numbers_.ofFan(n, f, t.component / 3, t.component % 3), t.sign};
    };
    for (int i = 1; i <= 2; ++i) {
      if (fan.firstGiven)
        rows_.follow(numbers_.ofFan(n, f, i, 0), {numbers_.alongArm(n, fan.first, i), 1});
      if (fan.lastGiven && fan.sectors == 1)
        rows_.follow(numbers_.ofFan(n, f, 0, i), {numbers_.alongArm(n, fan.first + 1, i), 1});
    }
    for (int k = 0; k <= fan.sectors; ++k) {
      for (int i = 1; i <= 2 && !given(fan, k); ++i)
        rows_.follow(numbers_.alongArm(n, fan.first + k, i), own(k, i, 0));
      for (int m = 0; m < 4 && k < fan.sectors; ++m)
        rows_.follow(numbers_.mixed(sector(n, fan.first + k), 1 + m / 2, 1 + m % 2),
                     own(k, 1 + m / 2, 1 + m % 2));
    }
  }
  // Whether another fan gives the derivatives along the k-th arm.
  static bool given(const Fan& fan, int k) {
    return k == 0 ? fan.firstGiven : k == fan.sectors && fan.lastGiven;
  }

  // A second-order jet in a chart of the fan, as around an irregular point.
  void foldChart(Index n, std::size_t f, double scale) {
    const Fan& fan = c_.fans[n][f];
    const Quadratic own{numbers_.ofFan(n, f, 1, 0), numbers_.ofFan(n, f, 0, 1),
                        numbers_.ofFan(n, f, 2, 0), numbers_.ofFan(n, f, 1, 1),
                        numbers_.ofFan(n, f, 0, 2)};
    solveGiven(n, f, scale);
    for (int k = 0; k <= fan.sectors; ++k) {
      const double angle = k * fan.step;
      if (!given(fan, k))
        jets_.alongArm(n, fan.first + k, own, characteristicSpoke(angle, fan.step, scale));
      if (k < fan.sectors)
        jets_.atCorner(sector(n, fan.first + k), own, characteristicCorner(angle, fan.step, scale));
    }
  }

  // Solves for A, C from the derivatives s A, s² C + t A along the first arm, and for B, E from
  // those along the last arm at its angle, unless it runs straight on from the first.
  void solveGiven(Index n, std::size_t f, double scale) {
    const Fan& fan = c_.fans[n][f];
    const auto spoke = characteristicSpoke(0, fan.step, scale);
    const double s = spoke[0].real(), t = spoke[1].real();
    const auto own = [&](int i, int j) { return numbers_.ofFan(n, f, i, j); };
    if (fan.firstGiven) {
      rows_.open(own(1, 0));
      rows_.add(numbers_.alongArm(n, fan.first, 1), 1 / s);
      rows_.close();
      rows_.open(own(2, 0));
      rows_.add(numbers_.alongArm(n, fan.first, 2), 1 / (s * s));
      rows_.add(own(1, 0), -t / (s * s));
      rows_.close();
    }
    const auto [d, c] = ode::sineCosine(fan.step * fan.sectors);
    if (!fan.lastGiven || std::abs(d) <= 1e-9) return;
    const std::size_t last = fan.first + fan.sectors;
    rows_.open(own(0, 1));
    rows_.add(numbers_.alongArm(n, last, 1), 1 / (s * d));
    rows_.add(own(1, 0), -c / d);
    rows_.close();
    const double e = 1 / (s * s * d * d);
    rows_.open(own(0, 2));
    rows_.add(numbers_.alongArm(n, last, 2), e);
    rows_.add(own(2, 0), -c * c / (d * d));
    rows_.add(own(1, 1), -2 * c / d);
    rows_.add(own(1, 0), -t * c * e);
    rows_.add(own(0, 1), -t * d * e);
    rows_.close();
  }

  const Connectivity& c_;
  const JetNumbers& numbers_;
  JetRows& rows_;
  QuadraticJets jets_;
};

}  // namespace

Result<void> chartHubs(const Wireframe& wireframe, const Connectivity& connectivity,
                       const JetNumbers& numbers, JetRows& rows) {
  HubCharts charts(wireframe, connectivity, numbers, rows);
  for (const Hub& hub : numbers.hubs())
    if (hub.first >= 0)
      if (auto ok = charts.chart(hub); !ok) return ok;
  return {};
}

void chartFans(const Connectivity& connectivity, const JetNumbers& numbers, JetRows& rows) {
  FanCharts charts(connectivity, numbers, rows);
  for (Index n = 0; n < static_cast<Index>(connectivity.kinds.size()); ++n)
    if (connectivity.kinds[n] == NodeKind::creased) charts.fold(n);
}

}  // namespace sweepface
