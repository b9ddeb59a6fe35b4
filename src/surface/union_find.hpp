#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Disjoint sets of the numbers below `size`; a set is named by its smallest member.
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size), size_(size, 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t size() const { return parent_.size(); }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }
  /// The size of the set that holds `a`.
  Index size(Index a) { return size_[find(a)]; }

 private:
  std::vector<Index> parent_, size_;
};

}  // namespace sweepface
