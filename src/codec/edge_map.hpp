#pragma once

#include <algorithm>
#include <compare>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "surface/sorting.hpp"

namespace sweepface::codec {

/// Values by directed edges, the first of each: counted by where edges begin and sorted by where
/// they end. Files choose edges freely, and could make any table of hashes slow.
template <typename Value>
class EdgeMap {
 public:
  struct Edge {
    Index from = -1, to = -1;
    Value value{};
  };

  /// Edges go between -1 and `ends` - 1; their values ascend.
  EdgeMap(std::span<const Edge> edges, Index ends) : first_(ends + 2), sorted_(edges.size()) {
    for (const Edge& edge : edges) ++first_[edge.from + 1];
    Index end = 0;
    for (Index& first : first_) first = end += first;
    for (const Edge& edge : edges) sorted_[--first_[edge.from + 1]] = {edge.to, edge.value};
    for (Index from = -1; from < ends; ++from)
      sortSmall(std::span(sorted_).subspan(first_[from + 1], countFrom(from)));
  }

  /// The value of an edge, or nothing.
  const Value* find(Index from, Index to) const {
    const auto edges = std::span(sorted_).subspan(first_[from + 1], countFrom(from));
    const auto found = std::ranges::lower_bound(edges, to, {}, &End::to);
    return found != edges.end() && found->to == to ? &found->value : nullptr;
  }

 private:
  struct End {
    Index to = -1;
    Value value{};
    auto operator<=>(const End&) const = default;
  };

  std::size_t countFrom(Index from) const { return first_[from + 2] - first_[from + 1]; }

  std::vector<Index> first_;  // of the edges from -1 on, and where the last ones end
  std::vector<End> sorted_;
};

}  // namespace sweepface::codec
