#include "codec/wireframe_rules.hpp"

#include <algorithm>

namespace sweepface::codec {

void joinRails(const Wireframe& w, UnionFind& sets) {
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s) {
      const auto side = w.side(p, s);
      for (std::size_t k = 1; k < side.size(); ++k) sets.join(arcOf(side[k - 1]), arcOf(side[k]));
    }
}

std::vector<Index> expectedRibbons(const Wireframe& w) {
  SweepRule rule(w);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) rule.sweep(p);
  std::vector<Index> ribbon(w.arcs.size(), -1), result(w.arcs.size());
  Index count = 0;
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    Index& r = ribbon[rule.sets.find(a)];
    if (r < 0) r = count++;
    result[a] = r;
  }
  return result;
}

std::vector<Index> expectedPoints(const Wireframe& w) {
  const std::size_t nodes = w.nodes.size();
  UnionFind sets(nodes);
  std::vector<char> hanging(nodes, 0);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s)
      for (std::size_t k = 1; k < w.side(p, s).size(); ++k) hanging[w.start(w.side(p, s)[k])] = 1;
  for (const Arc& arc : w.arcs)
    if (arc.collapsed) sets.join(arc.from, arc.to);
  std::vector<Index> ofSet(nodes, -1), result(nodes, -1);
  Index count = 0;
  for (Index n = 0; n < static_cast<Index>(nodes); ++n) {
    if (hanging[n]) continue;
    Index& point = ofSet[sets.find(n)];
    if (point < 0) point = count++;
    result[n] = point;
  }
  return result;
}

std::uint32_t lineClass(const Wireframe& w, const Connectivity& c, Index node, int axis) {
  const Star& star = c.stars[node];
  if (c.kinds[node] != NodeKind::crossing) return 15;
  std::int64_t reach[2] = {1, 1};  // in half edges
  int arms = 0;
  for (std::size_t k = static_cast<std::size_t>(axis); k < star.arms.size() && k < 4; k += 2) {
    const Rail& rail = c.rails[star.arms[k]];
    reach[arms++] =
        c.kinds[w.end(rail.last)] == NodeKind::hanging ? 2 * rail.edges - 1 : rail.edges;
  }
  const std::int64_t shorter = std::min(reach[0], reach[1]), longer = std::max(reach[0], reach[1]);
  const std::int64_t own = arms < 2 ? shorter + longer : shorter + std::min(longer, 3 * shorter);
  const std::uint32_t count = own < 4 ? 1 : own < 6 ? 2 : 3;
  return arms < 2 ? 4 + std::max(2u, count) : count;
}

}  // namespace sweepface::codec
