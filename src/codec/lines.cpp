#include "codec/lines.hpp"

#include <algorithm>
#include <utility>

#include "codec/derivative_rules.hpp"

namespace sweepface::codec {

Lines::Lines(const Surface& surface)
    : siteOf_(surface.wireframe().nodes.size(), -1),
      isOut_(siteOf_.size(), 0),
      links_(2 * surface.wireframe().arcs.size()) {
  const Wireframe& w = surface.wireframe();
  const Connectivity& c = surface.connectivity();
  std::vector<Index> ofPoint(w.points, -1);
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const StoredVector& s = surface.stored(v);
    if (s.i + s.j > 0) continue;
    siteOf_[s.node] = siteCount();
    sites_.emplace_back().irregular = c.kinds[s.node] == NodeKind::irregular;
    if (sites_.back().irregular) ofPoint[w.nodes[s.node].point] = siteOf_[s.node];
  }
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    if (c.kinds[n] == NodeKind::irregular) siteOf_[n] = ofPoint[w.nodes[n].point];
    if (siteOf_[n] >= 0) ++sites_[siteOf_[n]].nodes;
  }
  std::size_t count = 0;
  for (Site& site : sites_) {
    site.firstNode = count;
    count += std::exchange(site.nodes, 0);
  }
  nodes_.resize(count);
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    if (siteOf_[n] >= 0) {
      Site& site = sites_[siteOf_[n]];
      nodes_[site.firstNode + site.nodes++] = static_cast<Index>(n);
    }
  opposite_.reserve(links_.size());
  for (HalfArc h = 0; h < static_cast<HalfArc>(links_.size()); ++h) {
    const auto [last, edges] = c.rails[h];
    links_[h] = {twin(last), w.end(last), edges};
    longest_ = std::max(longest_, links_[h].distance);
    opposite_.push_back(oppositeOf(w, c, h));
  }
}

// Beyond what was taken out.
Lines::Link Lines::walkOn(Link link) const {
  for (std::size_t steps = 0; steps < links_.size() / 2; ++steps) {
    if (!isOut_[link.node]) return link;
    const HalfArc on = opposite_[link.back];
    if (on < 0 || links_[on].back < 0) return {};
    link = {links_[on].back, links_[on].node, link.distance + links_[on].distance};
  }
  return {};
}

Lines::Link Lines::beyond(const Link& link) {
  if (!isSite(link.node) || sites_[siteOf_[link.node]].irregular) return {};
  const HalfArc on = opposite_[link.back];
  if (on < 0) return {};
  Link next = walk(on);
  if (next.back < 0 || !isSite(next.node)) return {};
  next.distance += link.distance;
  return next;
}

}  // namespace sweepface::codec
