#include "surface/stored_jets.hpp"

#include <algorithm>

namespace sweepface {

StoredJets::StoredJets(const Surface& surface) {
  const Wireframe& w = surface.wireframe();
  const auto& kinds = surface.connectivity().kinds;
  std::vector<Index> first(w.points, -1);
  for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n) {
    home_.push_back(n);
    if (kinds[n] != NodeKind::irregular) continue;
    Index& home = first[w.nodes[n].point];
    if (home < 0) home = n;
    home_[n] = home;
  }
  Index fans = 0;
  for (const auto& own : surface.connectivity().fans) {
    start_.push_back(fans);
    fans += std::max<Index>(1, static_cast<Index>(own.size()));
  }
  at_.assign(9 * static_cast<std::size_t>(fans), -1);
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const auto& [node, i, j, fan] = surface.stored(v);
    at_[9 * (start_[node] + fan) + 3 * i + j] = v;
  }
}

}  // namespace sweepface
