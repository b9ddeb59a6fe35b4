#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The side of a face along an edge between two vertices.
struct EdgeSide {
  Index low, high;  ///< vertices
  bool isUp;        ///< whether it leads from `low` to `high`
  Index at;         ///< the caller's name for it

  EdgeSide(Index from, Index to, Index name)
      : low(std::min(from, to)), high(std::max(from, to)), isUp(from < to), at(name) {}
};

/// Sorts `sides` and calls visit(sides) for each edge with its sides in the order of their names.
template <typename Visit>
void eachSharedEdge(std::vector<EdgeSide>& sides, const Visit& visit) {
  const auto edge = [](const EdgeSide& s) { return std::tie(s.low, s.high); };
  std::ranges::sort(sides, {}, [](const EdgeSide& s) { return std::tie(s.low, s.high, s.at); });
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(),
                                  [&](const EdgeSide& s) { return edge(s) != edge(*begin); });
    visit(std::span<const EdgeSide>(begin, end));
    begin = end;
  }
}

/// Sets `twin` [names]: if exactly two faces share an edge, in opposite directions, their sides are
/// each other's twins; elsewhere it is -1. Returns the ends of edges that faces share otherwise.
std::vector<std::pair<Index, Index>> pairSides(std::vector<EdgeSide>& sides, std::span<Index> twin);

}  // namespace sweepface
