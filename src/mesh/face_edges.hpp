#pragma once

#include <span>
#include <vector>

#include "sweepface/mesh.hpp"

#include "mesh/face_repeats.hpp"

namespace sweepface {

/// The faces of a mesh, joined across the edges that exactly two of them share in opposite
/// directions. Vertices at the same place in all poses are welded. An edge is named by the face
/// corner at which it begins.
struct FaceEdges {
  std::vector<Index> face, next, previous;  ///< [C]
  std::vector<Index> vertex;                ///< [C] welded
  std::vector<Index> twin;                  ///< [C] or -1
};

/// With `repeats` [F], the vertices of backs are numbered from V on, and faces that are there
/// again, or have fewer than three different corners, share no edges.
FaceEdges faceEdges(const MeshRig& rig, std::span<const FaceRepeat> repeats = {});

/// The corners of a face at another vertex than the one before.
std::vector<Index> differentCorners(const FaceEdges& edges, const Polygons& polygons, Index face);

}  // namespace sweepface
