#include "surface/jet_numbers.hpp"

#include <array>
#include <cmath>

#include "ode/elementary.hpp"

namespace sweepface {

namespace {

// By quarter and component: the component that it is turned into, and the sign.
struct Turn {
  signed char component, sign;
};
constexpr auto kTurns = [] {
  std::array<std::array<Turn, 9>, 4> all{};
  for (int quarter = 0; quarter < 4; ++quarter)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int flips = (quarter == 1 || quarter == 2 ? j : 0) + (quarter >= 2 ? i : 0);
        const int component = quarter % 2 ? jetComponent(j, i) : jetComponent(i, j);
        all[quarter][jetComponent(i, j)] = {static_cast<signed char>(component),
                                            static_cast<signed char>(flips % 2 ? -1 : 1)};
      }
  return all;
}();

inline JetRef inQuarter(Index base, int quarter, int component) {
  const Turn turn = kTurns[quarter][component];
  return {base + turn.component, static_cast<double>(turn.sign)};
}

// Whether a fan stores component k: what its neighbours do not give, up to second order in a chart.
bool fanStores(const Fan& fan, int k) {
  if (!fan.regular && (k == 5 || k >= 7)) return false;
  if (fan.firstGiven && (k == 3 || k == 6)) return false;
  const bool lastIsY = fan.regular ? fan.sectors == 1
                                   : std::abs(ode::sineCosine(fan.step * fan.sectors).sine) > 1e-9;
  return !(fan.lastGiven && lastIsY && (k == 1 || k == 2));
}

}  // namespace

Turned turned(int quarter, int i, int j) {
  const auto [component, sign] = kTurns[quarter][jetComponent(i, j)];
  return {component, static_cast<double>(sign)};
}

JetNumbers::JetNumbers(const Wireframe& wireframe, const Connectivity& connectivity)
    : w_(wireframe), c_(connectivity) {
  const auto nodes = static_cast<Index>(w_.nodes.size());
  owners_.reserve(most());
  isStored_.reserve(owners_.capacity());
  base_.assign(nodes, -1);
  hubs_.resize(w_.points);
  armBase_.assign(nodes, -1);
  fanBase_.assign(nodes, -1);
  mixedBase_.assign(4 * w_.patches.size(), -1);
  for (Index n = 0; n < nodes; ++n) switch (c_.kinds[n]) {
      case NodeKind::irregular:
        numberIrregular(n);
        break;
      case NodeKind::creased:
        numberCreased(n);
        break;
      default:
        numberRegular(n);
    }
}

Index JetNumbers::add(StoredVector owner, bool stored) {
  owners_.push_back(owner);
  isStored_.push_back(stored);
  return count() - 1;
}

// An upper bound on the number of vectors.
std::size_t JetNumbers::most() const {
  std::size_t count = 9 * w_.nodes.size();
  for (std::size_t n = 0; n < w_.nodes.size(); ++n)
    if (c_.kinds[n] == NodeKind::irregular || c_.kinds[n] == NodeKind::creased)
      count += 8 * c_.fans[n].size() + 2 * c_.stars[n].arms.size() + 4 * c_.stars[n].sectors.size();
  return count;
}

void JetNumbers::numberRegular(Index n) {
  const bool crossing = c_.kinds[n] == NodeKind::crossing;
  base_[n] = count();
  for (int k = 0; k < 9; ++k)
    add({n, k / 3, k % 3}, crossing && (k == 0 || (w_.nodes[n].stored >> k & 1)));
}

void JetNumbers::numberIrregular(Index n) {
  Hub& hub = hubs_[w_.nodes[n].point];
  if (hub.first < 0) {
    constexpr int kOrders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    hub.first = count();
    for (auto [i, j] : kOrders) add({n, i, j}, true);
  }
  hub.nodes.push_back(n);
  numberArms(n);
}

void JetNumbers::numberCreased(Index n) {
  base_[n] = add({n, 0, 0}, true);
  fanBase_[n] = count();
  const auto& fans = c_.fans[n];
  for (int f = 0; f < static_cast<int>(fans.size()); ++f)
    for (int k = 1; k < 9; ++k) add({n, k / 3, k % 3, f}, fanStores(fans[f], k));
  numberArms(n);
}

// Nodes without axes of their own have vectors per arm and per corner.
void JetNumbers::numberArms(Index n) {
  const Star& star = c_.stars[n];
  armBase_[n] = count();
  for (std::size_t k = 0; k < 2 * star.arms.size(); ++k) add({n, 0, 0}, false);
  for (Index corner : star.sectors) {
    mixedBase_[corner] = count();
    for (int k = 0; k < 4; ++k) add({n, 0, 0}, false);
  }
}

JetRef JetNumbers::atCorner(Index corner, int i, int j) const {
  const int quarter = quarterOf(corner);
  return quarter < 0 ? byArms(corner, i, j)
                     : inQuarter(base_[c_.cornerNode[corner]], quarter, jetComponent(i, j));
}

std::array<JetRef, 9> JetNumbers::atCorner(Index corner) const {
  const int quarter = quarterOf(corner);
  const Index base = base_[c_.cornerNode[corner]];
  std::array<JetRef, 9> jets;
  for (int k = 0; k < 9; ++k)
    jets[k] = quarter < 0 ? byArms(corner, k / 3, k % 3) : inQuarter(base, quarter, k);
  return jets;
}

// The right angles by which a corner of a crossing or a T-node is turned from the node's axes; -1
// at other nodes.
int JetNumbers::quarterOf(Index corner) const {
  const Index n = c_.cornerNode[corner];
  const int sector = c_.cornerSector[corner];
  switch (c_.kinds[n]) {
    case NodeKind::crossing:
      return sector;
    case NodeKind::hanging:
      return (sector - hostArm(n) + 3) % 3;
    default:
      return -1;
  }
}

JetRef JetNumbers::byArms(Index corner, int i, int j) const {
  const Index n = c_.cornerNode[corner];
  if (i == 0 && j == 0)
    return {c_.kinds[n] == NodeKind::creased ? base_[n] : hubs_[w_.nodes[n].point].first, 1};
  const int sector = c_.cornerSector[corner];
  if (j == 0) return {alongArm(n, sector, i), 1};
  if (i == 0) return {alongArm(n, sector + 1, j), 1};
  return {mixed(corner, i, j), 1};
}

int JetNumbers::hostArm(Index node) const {
  return static_cast<int>(c_.stars[node].straight() + 1) % 3;
}

}  // namespace sweepface
