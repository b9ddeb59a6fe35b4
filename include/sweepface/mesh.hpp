#pragma once

#include <string>
#include <vector>

#include "sweepface/polygons.hpp"
#include "sweepface/result.hpp"

namespace sweepface {

/// A polygon mesh in model units. Knows nothing of file formats.
struct PolygonMesh {
  std::vector<Vec3> positions;  ///< [V × 3]
  Polygons polygons;
};

/// A named expression: the neutral's vertices at weight 1.
struct MeshTarget {
  std::string name;
  std::vector<Vec3> positions;  ///< [V × 3], in the neutral's vertex order
};

/// A neutral mesh with its expressions, as it was read.
struct MeshRig {
  PolygonMesh neutral;
  std::vector<MeshTarget> targets;

  /// The positions of pose 0, the neutral, or of target pose - 1: [V × 3].
  const std::vector<Vec3>& positionsOf(Index pose) const {
    return pose == 0 ? neutral.positions : targets[pose - 1].positions;
  }
};

}  // namespace sweepface
