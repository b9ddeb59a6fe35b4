#include "surface/stored_jets.hpp"

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
  at_.assign(9 * w.nodes.size(), -1);
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const StoredVector& stored = surface.stored(v);
    at_[9 * stored.node + 3 * stored.i + stored.j] = v;
  }
}

}  // namespace sweepface
