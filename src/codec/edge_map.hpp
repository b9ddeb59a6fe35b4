#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "surface/groups.hpp"

namespace sweepface::codec {

/// Finds directed edges: counted by where they end and then by where they begin. Files choose edges
/// freely, and could make any table of hashes slow.
class EdgeMap {
 public:
  struct Edge {
    Index from = -1, to = -1;
  };

  /// Edges go between -1 and `ends` - 1.
  EdgeMap(std::span<const Edge> edges, Index ends);

  /// The number of the first such edge, or -1.
  Index find(Index from, Index to) const;

 private:
  std::vector<Index> number_, to_;  // of the edges in the order of where they end
  std::optional<Groups> leaving_;   // places in these, by where edges begin, from -1 on
};

}  // namespace sweepface::codec
