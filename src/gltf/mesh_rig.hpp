#pragma once

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// The rig of a file's parts in the space of its scene, with triangles for faces. Its memory stays
/// in proportion to the bytes that were read.
Result<MeshRig> readMeshRig(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
