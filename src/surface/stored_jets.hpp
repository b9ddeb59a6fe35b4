#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Where a surface stores the jets of its nodes.
class StoredJets {
 public:
  explicit StoredJets(const Surface& surface);
  /// The stored vector ∂x^i ∂y^j (index 3i + j) of a node, or of all irregular nodes at its point;
  /// -1 if it is predicted or derived. At a creased node, that of one fan.
  Index at(Index node, int component, int fan = 0) const {
    return at_[9 * (start_[home_[node]] + fan) + component];
  }
  /// The node that stands for all irregular nodes at the same point; any other node itself.
  Index home(Index node) const { return home_[node]; }

 private:
  std::vector<Index> home_;   // [nodes]
  std::vector<Index> start_;  // [nodes] first fan of each; a node without any counts as one
  std::vector<Index> at_;     // [9·fans]
};

}  // namespace sweepface
