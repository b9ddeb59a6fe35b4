#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "surface/groups.hpp"

namespace sweepface::codec {

/// The lines of a wireframe, from which sites are removed one by one. A site is a node with stored
/// vectors, or all nodes at an irregular point; T-nodes are not sites.
class Lines {
 public:
  explicit Lines(const Surface& surface);

  /// The site of each node [nodes], -1 for T-nodes; sites are numbered in the order of their
  /// vectors.
  const std::vector<Index>& siteOf() const { return siteOf_; }
  Index siteOf(Index node) const { return siteOf_[node]; }
  bool isSite(Index node) const { return siteOf_[node] >= 0; }
  Index siteCount() const { return static_cast<Index>(sites_.size()); }
  std::span<const Index> nodesOf(Index site) const { return nodes_->of(site); }

  bool isLeft(Index site) const { return sites_[site].left; }
  void takeOut(Index site) {
    sites_[site].left = false;
    for (const Index node : nodesOf(site)) isOut_[node] = 1;
  }

  /// Where a line leads from a half-arc: the next remaining node, and the half-arc that leads back
  /// from it; -1 if there is none.
  struct Link {
    HalfArc back = -1;
    Index node = -1;
    Index distance = 0;
    bool collapsed = false;  ///< it begins with a collapsed arc
  };
  /// The first T-node or remaining site along a line.
  const Link& walk(HalfArc h) {
    static constexpr Link kNone;
    if (h < 0) return kNone;
    Link& link = links_[h];
    if (link.back >= 0 && isOut_[link.node]) walkOn(link);
    return link;
  }
  /// The next site on the same line beyond a remaining one.
  Link beyond(const Link& link);
  /// The longest distance to the next node on a line while no site has been removed.
  Index longest() const { return longest_; }

 private:
  struct Site {
    bool left = true, irregular = false;
  };

  void walkOn(Link& link) const;

  std::vector<Index> siteOf_;      // [nodes]
  std::vector<char> isOut_;        // [nodes]
  std::vector<Site> sites_;        // [sites]
  std::optional<Groups> nodes_;    // [sites] the nodes of each
  std::vector<Link> links_;        // [half-arcs] as far as walked: removed sites stay out
  std::vector<HalfArc> opposite_;  // [half-arcs] the opposite one at its start, straight on
  Index longest_ = 0;
};

}  // namespace sweepface::codec
