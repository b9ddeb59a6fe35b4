#include "codec/lines.hpp"

#include <algorithm>

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
    if (!s.isPosition()) continue;
    siteOf_[s.node] = siteCount();
    sites_.emplace_back().irregular = c.kinds[s.node] == NodeKind::irregular;
    if (sites_.back().irregular) ofPoint[w.nodes[s.node].point] = siteOf_[s.node];
  }
  for (std::size_t n = 0; n < w.nodes.size(); ++n) {
    if (c.kinds[n] == NodeKind::irregular) siteOf_[n] = ofPoint[w.nodes[n].point];
  }
  nodes_.emplace(siteOf_, sites_.size());
  opposite_.reserve(links_.size());
  for (HalfArc h = 0; h < static_cast<HalfArc>(links_.size()); ++h) {
    const auto [last, edges] = c.rails[h];
    links_[h] = {twin(last), w.end(last), edges, w.arcs[arcOf(h)].collapsed};
    longest_ = std::max(longest_, links_[h].distance);
    opposite_.push_back(c.opposite(w, h));
  }
}

// Removed sites stay out, so the next walk begins where this one ends. On a ring where nothing is
// left, the walk ends when it returns to where it was after 1, 2, 4 ... steps (Brent 1980).
void Lines::walkOn(Link& link) const {
  HalfArc mark = -1;
  for (std::size_t steps = 1, marked = 1; link.back >= 0 && isOut_[link.node]; ++steps) {
    HalfArc on = opposite_[link.back];
    if (on == mark) on = -1;
    if (steps == marked) mark = on, marked *= 2;
    const Link next = on < 0 ? Link{} : links_[on];
    link = {next.back, next.node, link.distance + next.distance, link.collapsed};
  }
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
