#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// What subdivision needs to know of a mesh. Vertices at the same place in all poses are welded, as
/// are the same texture coordinates there; a sheet and its back share none. Faces that are there
/// again, or have no area, are left out.
struct Cage {
  std::vector<Index> vertices;  ///< [K] the source's vertices: those of faces, and loose ones
  std::vector<Index> faces;     ///< [F] the source's faces
  std::vector<Index> sizes;     ///< [F] corners of each face
  std::vector<Index> corners;   ///< [C] index into `vertices`
  std::vector<Vec2> texcoords;  ///< [T] one for each vertex and value
  std::vector<Index> cornerTexcoords;  ///< [C] index into `texcoords`; empty if there are none
  std::vector<char> isTextured;        ///< [F] whether all corners of a face have coordinates
  std::vector<std::string> warnings;   ///< about faces that are left out, in sentences
};

/// The cage of meshes whose indices are valid.
Cage cageOf(const MeshRig& rig);

}  // namespace sweepface
