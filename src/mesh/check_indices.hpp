#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Refuses meshes whose counts or indices do not match; the error says which, as a fragment of a
/// sentence.
Result<void> checkIndices(const MeshRig& meshes);

}  // namespace sweepface
