#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Where a surface stores the jets of its nodes.
class StoredJets {
 public:
  explicit StoredJets(const Surface& surface);
  /// The stored vector ∂x^i ∂y^j (index 3i + j) of a node, or of all irregular nodes at its point;
  /// -1 if it is predicted or derived.
  Index at(Index node, int component) const { return at_[9 * home_[node] + component]; }
  /// Of the irregular nodes at a point the one that stands for all; every other node itself.
  Index home(Index node) const { return home_[node]; }

 private:
  std::vector<Index> home_;  // [nodes]
  std::vector<Index> at_;    // [9·nodes]
};

}  // namespace sweepface
