#pragma once

#include <span>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// The faces of a mesh after its triangles were joined into quads.
struct RecoveredQuads {
  Polygons polygons;    ///< faces between the same vertices; a quad takes the place of its first
                        ///< triangle, and a fan from its first corner gives both, that one first
  Index recovered = 0;  ///< quads made, of two triangles each
  Index triangles = 0;  ///< triangles that are left
};

/// Joins pairs of triangles into the quads they were cut from, judged by the neutral. Quads and
/// larger polygons stay as they are.
///
/// `copies` names for every vertex the first one with the same attributes at the same place in all
/// poses, so that an edge between copies is no seam; if empty, every vertex is its own.
/// Triangles of different `parts` [faces], if there are any, are never joined.
RecoveredQuads recoverQuads(const MeshRig& rig, std::span<const Index> copies = {},
                            std::span<const Index> parts = {});

}  // namespace sweepface
