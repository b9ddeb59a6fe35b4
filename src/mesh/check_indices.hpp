#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Refuses meshes whose counts or indices do not match; the error is a fragment of a sentence.
Result<void> checkIndices(const MeshRig& meshes);

}  // namespace sweepface
