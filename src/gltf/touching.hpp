#pragma once

#include <string>

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A sentence that names the meshes shown beside the face that have vertices where the face has
/// some that never move, as a body at the neck; empty if there are none. `rig` is that of the
/// parts. Meshes that cannot be read do not count.
std::string touchingMeshes(const Document& document, const Parts& parts, const MeshRig& rig);

}  // namespace sweepface::gltf
