#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Refuses meshes whose counts and indices do not belong together; a fragment of a sentence says
/// which.
Result<void> checkIndices(const MeshRig& meshes);

}  // namespace sweepface
