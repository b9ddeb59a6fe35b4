#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/result.hpp"

namespace sweepface {

/// The most levels that subdivide() takes.
inline constexpr int kMostSubdivisions = 5;

/// What subdivide() makes.
struct Subdivision {
  MeshRig rig;
  std::vector<std::string> warnings;  ///< about faces that are left out, in sentences
};

/// The limit surface of meshes that were made to be subdivided, by Catmull and Clark's scheme
/// (1978): each face becomes as many quads as it has corners, and `levels - 1` times each of these
/// four; the vertices then move to where further levels would carry them. Vertices at the same
/// place in all poses are welded before; the others come first, in their order, then those of the
/// backs of sheets, then new ones. Open edges stay edges and their corners stay corners, as USD's
/// `edgeAndCorner` has it; texture coordinates follow as with its `cornersPlus1`. Fails if indices
/// do not match or the result would have more than 4 million faces. Docs: docs/subdivision.md.
Result<Subdivision> subdivide(const MeshRig& cage, int levels);

}  // namespace sweepface
