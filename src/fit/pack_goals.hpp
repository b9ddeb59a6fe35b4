#pragma once

#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Where packing is to leave the vertices of level 1.
struct PackGoals {
  std::vector<char> isKnown;              ///< [vertices] whether it is to be anywhere
  std::vector<std::vector<Vec3>> places;  ///< [poses][vertices] the neutral, then ways from it
};

/// Where a source has its vertices; one at which sheets touch has a place on each of them.
PackGoals goalsOf(const Rig& rig, const MeshRig& source);
/// Where they are.
PackGoals goalsOf(const Rig& rig);

}  // namespace sweepface
