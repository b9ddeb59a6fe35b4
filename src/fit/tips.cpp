#include "fit/tips.hpp"

#include <algorithm>

namespace sweepface {
namespace {

bool endsASinglePatch(const Connectivity& connectivity, Index node) {
  const Star& star = connectivity.stars[node];
  return !star.closed && star.sectors.size() == 1;
}

bool isTip(const Surface& surface, Index node) {
  const Wireframe& w = surface.wireframe();
  const Connectivity& c = surface.connectivity();
  return endsASinglePatch(c, node) && std::ranges::any_of(c.stars[node].arms, [&](HalfArc arm) {
           const Arc& arc = w.arcs[arcOf(arm)];
           return arc.collapsed && arc.edges == 1 && endsASinglePatch(c, w.end(arm));
         });
}

}  // namespace

void dropSlopesAtTips(const Surface& surface, Solution& solution) {
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const auto& [node, i, j, fan] = surface.stored(v);
    const bool leadsInside = i == 0 && j == 1;
    if (leadsInside && surface.connectivity().kinds[node] == NodeKind::irregular &&
        isTip(surface, node))
      solution.row(v).setZero();
  }
}

}  // namespace sweepface
