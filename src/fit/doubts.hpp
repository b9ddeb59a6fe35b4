#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Sentences on what can be converted but is hardly meant: a tolerance like the mesh's size,
/// targets in other units or another order of vertices, and those that move no vertex of a face by
/// more than the tolerance.
std::vector<std::string> doubtsAbout(const MeshRig& source, double tolerance);

}  // namespace sweepface
