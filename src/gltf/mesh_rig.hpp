#pragma once

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A rig in the space of a file's scene, with triangles for faces.
struct PartedRig {
  MeshRig rig;
  std::vector<Index> facePart;  ///< [faces] in Parts::parts
};

/// Reads the rig from a file's parts. Memory stays in proportion to the bytes that were read.
Result<PartedRig> readMeshRig(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
