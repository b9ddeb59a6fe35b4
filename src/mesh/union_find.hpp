#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Disjoint sets of the numbers below `size`; a set is named by its smallest member.
class UnionFind {
 public:
  explicit UnionFind(Index size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace sweepface
