#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/hierarchy.hpp"
#include "codec/lines.hpp"

namespace sweepface::codec {

/// Searches for the nearest sites along what is left of the lines (Dijkstra 1959). The length of a
/// search is bounded, however many T-nodes and spokes there are.
class NearSites {
 public:
  NearSites(const Surface& surface, Lines& lines) : c_(surface.connectivity()), lines_(lines) {}

  static constexpr std::size_t kMost = 16;
  /// The 12 nearest sites, if there are that many, and those at the distance of the last, up to
  /// kMost. Leaves out `image`, the site's own mirror image (or -1), so that both find the same
  /// sites. Valid until the next search.
  std::span<const Index> around(Index site, Index image);

 private:
  // A node waiting to be visited, the nearest first.
  struct Waiting {
    std::uint64_t key;
    Waiting(Index distance, Index node) : key(static_cast<std::uint64_t>(distance) << 32 | node) {}
    Index distance() const { return static_cast<Index>(key >> 32); }
    Index node() const { return static_cast<Index>(key); }
    bool operator>(const Waiting& other) const { return key > other.key; }
  };

  void goOn(Index node, Index distance);
  Index& reachedBy(Index node) {
    const Index site = lines_.siteOf(node);
    return reachedBy_[site >= 0 ? site : lines_.siteCount() + node];
  }

  const Connectivity& c_;
  Lines& lines_;
  std::vector<Waiting> queue_;    // a heap
  std::vector<Index> reachedBy_;  // [sites, then nodes] the last search that reached it
  std::vector<Index> found_;
  Index search_ = 0;
};

/// For each site of a hierarchy, the earlier sites nearest to it along the lines at the time when
/// it was removed; none for a root.
class NearTable {
 public:
  NearTable(const Surface& surface, const Hierarchy& hierarchy);

  std::span<const Index> of(Index site) const {
    const auto [first, end] = range_[site];
    return {near_.data() + first, near_.data() + end};
  }

 private:
  std::vector<std::array<Index, 2>> range_;  // [sites] each site's range in `near_`
  std::vector<Index> near_;
};

}  // namespace sweepface::codec
