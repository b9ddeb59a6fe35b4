#pragma once

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// The rig of a file's parts in the space of its scene, with triangles for faces.
struct PartedRig {
  MeshRig rig;
  std::vector<Index> facePart;  ///< [faces] in Parts::parts
};

/// Its memory stays in proportion to the bytes that were read.
Result<PartedRig> readMeshRig(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
