#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// Finds directed edges: counted by where they begin and sorted by where they end. Files choose
/// edges freely, and could make any table of hashes slow.
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
  struct End {
    Index to = -1, edge = -1;
  };

  std::size_t countFrom(Index from) const { return first_[from + 2] - first_[from + 1]; }

  std::vector<Index> first_;  // of the edges from -1 on, and where the last ones end
  std::vector<End> sorted_;
};

}  // namespace sweepface::codec
