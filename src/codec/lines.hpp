#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// What is left of the lines of a wireframe while sites are taken out of them. A site is a node
/// with stored vectors, or all nodes at an irregular point; T-nodes are none.
class Lines {
 public:
  explicit Lines(const Surface& surface);

  /// The site of each node [nodes], -1 for T-nodes; sites are numbered as their vectors are.
  const std::vector<Index>& siteOf() const { return siteOf_; }
  Index siteOf(Index node) const { return siteOf_[node]; }
  bool isSite(Index node) const { return siteOf_[node] >= 0; }
  Index siteCount() const { return static_cast<Index>(sites_.size()); }
  std::span<const Index> nodesOf(Index site) const {
    return {nodes_.data() + sites_[site].firstNode, sites_[site].nodes};
  }

  bool isLeft(Index site) const { return sites_[site].left; }
  void takeOut(Index site) {
    sites_[site].left = false;
    for (const Index node : nodesOf(site)) isOut_[node] = 1;
  }

  /// Where a line leads from a half-arc: to the half-arc that comes back from the next node that is
  /// left; -1 where there is none.
  struct Link {
    HalfArc back = -1;
    Index node = -1;
    Index distance = 0;
  };
  /// The first T-node or site that is left along a line.
  Link walk(HalfArc h) {
    if (h < 0) return {};
    const Link& link = links_[h];
    return link.back < 0 || !isOut_[link.node] ? link : links_[h] = walkOn(link);
  }
  /// One more site beyond one that is left, on the same line.
  Link beyond(const Link& link);
  /// The longest distance along a line to the next node while all are left.
  Index longest() const { return longest_; }

 private:
  struct Site {
    std::size_t firstNode = 0, nodes = 0;
    bool left = true, irregular = false;
  };

  Link walkOn(Link link) const;

  std::vector<Index> siteOf_;      // [nodes]
  std::vector<char> isOut_;        // [nodes]
  std::vector<Site> sites_;        // [sites]
  std::vector<Index> nodes_;       // by sites
  std::vector<Link> links_;        // [half-arcs] what was taken out stays out
  std::vector<HalfArc> opposite_;  // [half-arcs] that go straight on, behind where one begins
  Index longest_ = 0;
};

}  // namespace sweepface::codec
