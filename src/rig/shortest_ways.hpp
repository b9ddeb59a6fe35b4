#pragma once

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The neighbours of a node and the distances to them.
using Ways = std::vector<std::pair<Index, double>>;

/// Completes distances [nodes], starting from the finite ones (E. W. Dijkstra, "A note on two
/// problems in connexion with graphs", 1959).
inline void shortestWays(const std::vector<Ways>& ways, std::vector<double>& distances) {
  using Step = std::pair<double, Index>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  for (Index n = 0; n < static_cast<Index>(distances.size()); ++n)
    if (distances[n] < std::numeric_limits<double>::infinity()) next.emplace(distances[n], n);
  while (!next.empty()) {
    const auto [distance, node] = next.top();
    next.pop();
    if (distance > distances[node]) continue;
    for (const auto& [other, length] : ways[node])
      if (distance + length < distances[other])
        next.emplace(distances[other] = distance + length, other);
  }
}

}  // namespace sweepface
