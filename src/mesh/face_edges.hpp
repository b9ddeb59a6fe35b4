#pragma once

#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// The faces of a mesh, joined across the edges that exactly two of them share in opposite
/// directions. Vertices at the same place in all poses are welded. An edge is named by the face
/// corner at which it begins.
struct FaceEdges {
  std::vector<Index> face, next, previous;  ///< [C]
  std::vector<Index> vertex;                ///< [C] welded
  std::vector<Index> twin;                  ///< [C] or -1
};

FaceEdges faceEdges(const MeshRig& rig);

}  // namespace sweepface
