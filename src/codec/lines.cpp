#include "codec/lines.hpp"

#include <algorithm>

#include "codec/derivative_rules.hpp"

namespace sweepface::codec {

Lines::Lines(const Surface& surface)
    : w_(surface.wireframe()), siteOf_(w_.nodes.size(), -1), links_(2 * w_.arcs.size()) {
  const Connectivity& c = surface.connectivity();
  std::vector<Index> ofPoint(w_.points, -1);
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const StoredVector& s = surface.stored(v);
    if (s.i + s.j > 0) continue;
    siteOf_[s.node] = siteCount();
    sites_.emplace_back().irregular = c.kinds[s.node] == NodeKind::irregular;
    if (sites_.back().irregular) ofPoint[w_.nodes[s.node].point] = siteOf_[s.node];
  }
  for (std::size_t n = 0; n < w_.nodes.size(); ++n) {
    if (c.kinds[n] == NodeKind::irregular) siteOf_[n] = ofPoint[w_.nodes[n].point];
    if (siteOf_[n] >= 0) sites_[siteOf_[n]].nodes.push_back(static_cast<Index>(n));
  }
  opposite_.reserve(links_.size());
  for (HalfArc h = 0; h < static_cast<HalfArc>(links_.size()); ++h) {
    links_[h] = {twin(c.rails[h].last), c.rails[h].edges};
    longest_ = std::max(longest_, links_[h].distance);
    opposite_.push_back(oppositeOf(w_, c, h));
  }
}

// What was taken out stays out: the next walk begins where this one ends.
Lines::Link Lines::walk(HalfArc h) {
  if (h < 0) return {};
  Link link = links_[h];
  for (std::size_t steps = 0; steps < w_.arcs.size(); ++steps) {
    const Index node = w_.start(link.back);
    if (!isSite(node) || isLeft(siteOf_[node])) return links_[h] = link;
    const HalfArc on = opposite_[link.back];
    if (on < 0) return {};
    link = {links_[on].back, link.distance + links_[on].distance};
  }
  return {};
}

Lines::Link Lines::beyond(const Link& link) {
  const Index node = w_.start(link.back);
  if (!isSite(node) || sites_[siteOf_[node]].irregular) return {};
  const HalfArc on = opposite_[link.back];
  if (on < 0) return {};
  Link next = walk(on);
  if (next.back < 0 || !isSite(w_.start(next.back))) return {};
  next.distance += link.distance;
  return next;
}

}  // namespace sweepface::codec
