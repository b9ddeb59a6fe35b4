#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "surface/groups.hpp"

namespace sweepface::codec {

/// Finds directed edges, sorted by start and then by end in two passes of counting sort. It is not
/// a hash table, since a file chooses its edges freely and could slow down any hash table.
class EdgeMap {
 public:
  struct Edge {
    Index from = -1, to = -1;
  };

  /// Both `from` and `to` of an edge lie between -1 and `ends` - 1.
  EdgeMap(std::span<const Edge> edges, Index ends);

  /// The index of the first such edge, or -1.
  Index find(Index from, Index to) const;

 private:
  std::vector<Index> number_, to_;  // of the edges, sorted by their end
  std::optional<Groups> leaving_;   // positions in these, grouped by start, from -1 on
};

}  // namespace sweepface::codec
