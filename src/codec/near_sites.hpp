#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/lines.hpp"

namespace sweepface::codec {

/// Searches for the sites that are nearest along what is left of the lines (Dijkstra 1959). However
/// many T-nodes and spokes there are, a search is short.
class NearSites {
 public:
  NearSites(const Surface& surface, Lines& lines);

  static constexpr std::size_t kMost = 16;
  /// At least 12 sites where there are as many, and those as far away as the last. Without the
  /// site's own mirror image (or -1), so that both see the same. Until the next search.
  std::span<const Index> around(Index site, Index image);

 private:
  // A node that the search will come to, the nearest first.
  struct Waiting {
    std::uint64_t key;
    Waiting(Index distance, Index node) : key(static_cast<std::uint64_t>(distance) << 32 | node) {}
    Index distance() const { return static_cast<Index>(key >> 32); }
    Index node() const { return static_cast<Index>(key); }
    bool operator>(const Waiting& other) const { return key > other.key; }
  };

  void goOn(Index node, Index distance);

  Lines& lines_;
  std::vector<Index> firstArm_;   // [nodes + 1]
  std::vector<HalfArc> arms_;     // that leave each node, but for those that are one point
  std::vector<Index> place_;      // [nodes] in the list below: all nodes of a site share one
  std::vector<Index> reachedBy_;  // the last search that was there
  std::vector<Waiting> queue_;    // a heap
  std::vector<Index> found_;
  Index search_ = 0;
};

}  // namespace sweepface::codec
