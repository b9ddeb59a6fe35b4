#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Warnings, in sentences, about input that can be converted but is probably a mistake: a tolerance
/// close to the mesh's size, far above its edge lengths or too fine for a coarse mesh; and targets
/// that equal the neutral, seem to have other units, axes or another origin or vertex order, or are
/// named like a neutral.
std::vector<std::string> doubtsAbout(const MeshRig& source, double tolerance);

}  // namespace sweepface
