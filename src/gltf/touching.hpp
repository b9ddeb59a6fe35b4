#pragma once

#include <span>
#include <string>

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A sentence that names the meshes shown beside the face that have vertices where its rim has some
/// that never move, as a body at the neck; empty if there are none. `rig` is that of the parts,
/// `places` the result of weld() for it. Copies of the face and what cannot be read do not count.
std::string touchingMeshes(const Document& document, const Parts& parts, const MeshRig& rig,
                           std::span<const Index> places);

}  // namespace sweepface::gltf
