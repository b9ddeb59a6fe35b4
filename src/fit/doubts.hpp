#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Sentences on what can be converted but is hardly meant: a tolerance like the mesh's size or far
/// above its edges or too fine for a coarse mesh, and targets that are the neutral, or seem to have
/// other units, axes or another origin or order of vertices, or are called like a neutral.
std::vector<std::string> doubtsAbout(const MeshRig& source, double tolerance);

}  // namespace sweepface
