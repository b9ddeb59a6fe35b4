#pragma once

#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Where packing should leave the vertices of level 1.
struct PackGoals {
  std::vector<char> isKnown;              ///< [vertices] whether there is a goal
  std::vector<std::vector<Vec3>> places;  ///< [poses][vertices] the neutral, then moves from it
};

/// The positions of the source's vertices; one at which sheets touch is a goal on each of them.
PackGoals goalsOf(const Rig& rig, const MeshRig& source);
/// The positions that the vertices have now.
PackGoals goalsOf(const Rig& rig);

}  // namespace sweepface
