#include "edit/affected.hpp"

namespace sweepface::edit {

template <typename Visit>
void Affected::eachCornerVector(Index corner, Visit visit) const {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) visit(surface_.cornerJet(corner / 4, corner % 4, i, j).vector);
}

void Affected::addRibbon(Index ribbon) {
  for (Index p = 0; p < surface_.patchCount(); ++p)
    for (int s = 0; s < 4; ++s)
      if (ribbonOf(surface_.wireframe().side(p, s)[0]) == ribbon) patches_[p] = true;
  const Connectivity& c = surface_.connectivity();
  for (Index n = 0; n < static_cast<Index>(c.kinds.size()); ++n) {
    if (c.kinds[n] != NodeKind::hanging) continue;
    const Star& star = c.stars[n];
    bool stands = false;
    for (int arm = 0; arm < std::ssize(star.arms); ++arm)
      stands = stands || (c.opposite(n, arm) >= 0 && ribbonOf(star.arms[arm]) == ribbon);
    if (!stands) continue;
    for (Index corner : star.sectors)
      if (corner != kStraight) eachCornerVector(corner, [&](Index v) { vectors_[v] = true; });
  }
}

std::vector<Index> Affected::patches() {
  for (Index v = surface_.storedCount(); v < surface_.vectorCount(); ++v)
    for (const Term& t : surface_.derivation(v))
      if (vectors_[t.vector]) vectors_[v] = true;
  std::vector<Index> result;
  for (Index p = 0; p < surface_.patchCount(); ++p) {
    bool reached = patches_[p];
    for (Index corner = 4 * p; corner < 4 * p + 4; ++corner)
      eachCornerVector(corner, [&](Index v) { reached = reached || vectors_[v]; });
    if (reached) result.push_back(p);
  }
  return result;
}

}  // namespace sweepface::edit
