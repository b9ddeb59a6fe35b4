#include "surface/creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sweepface {

bool isCrease(const Wireframe& w, const Connectivity& c, Index arc) {
  return w.arcs[arc].crease && c.patchOf[2 * arc] >= 0 && c.patchOf[2 * arc + 1] >= 0;
}

namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

// Gives a fan its total angle. A single sector can join any two arms, so it is always regular.
void open(Fan& fan, double angle) {
  fan.step = angle / fan.sectors;
  fan.regular = fan.sectors == 1 || std::abs(fan.step - kRightAngle) < 1e-9;
}

// The fans of an open star run from boundary to boundary. Each takes its first arm from the one
// before it and is otherwise like a node on a boundary.
void chain(std::vector<Fan>& fans) {
  for (std::size_t k = 0; k < fans.size(); ++k) {
    open(fans[k], fans[k].sectors <= 2 ? kRightAngle * fans[k].sectors : std::numbers::pi);
    fans[k].firstGiven = k > 0;
  }
}

// Around a closed star the last fan must meet the first. A fan of one sector can join any two arms,
// so if there is one, it comes last. Otherwise two fans meet along a straight line, and more than
// two share the full turn equally. Of two fans the regular one gives the line: in the other's chart
// the halves of the line bend differently, which would cut the regular fan in two.
void close(std::vector<Fan>& fans, int sectors) {
  const auto single = std::ranges::find(fans, 1, &Fan::sectors);
  const bool joins = single != fans.end();
  const bool isTurned = fans.size() == 2 && fans[0].sectors != 2;
  const auto first = joins ? single - fans.begin() + 1 : isTurned ? 1 : 0;
  // std::rotate would be 0.7 KB of what a browser has to load.
  std::vector<Fan> turned(fans.begin() + first, fans.end());
  turned.insert(turned.end(), fans.begin(), fans.begin() + first);
  fans = std::move(turned);
  const auto count = static_cast<double>(fans.size());
  for (std::size_t k = 0; k < fans.size(); ++k) {
    Fan& fan = fans[k];
    open(fan, joins ? 2 * std::numbers::pi * fan.sectors / sectors : 2 * std::numbers::pi / count);
    fan.firstGiven = k > 0;
  }
  fans.back().lastGiven = true;
}

}  // namespace

std::vector<Fan> fansOf(const Wireframe& w, const Connectivity& c, const Star& star) {
  const int arms = static_cast<int>(star.arms.size()),
            sectors = static_cast<int>(star.sectors.size());
  std::vector<int> cuts;
  for (int k = 0; k < arms; ++k)
    if (isCrease(w, c, arcOf(star.arms[k]))) cuts.push_back(k);
  if (cuts.size() < (star.closed ? 2u : 1u)) return {};
  if (!star.closed) cuts.insert(cuts.begin(), 0);
  cuts.push_back(star.closed ? cuts.front() + arms : sectors);
  std::vector<Fan> fans;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    fans.push_back({cuts[k], cuts[k + 1] - cuts[k]});
  if (star.closed)
    close(fans, sectors);
  else
    chain(fans);
  return fans;
}

}  // namespace sweepface
