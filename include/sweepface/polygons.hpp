#pragma once

#include <string>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The faces of a polygon mesh and their attributes, without positions.
struct Polygons {
  std::vector<Index> faceStart{0};  ///< [F + 1] first corner of each face
  std::vector<Index> corners;       ///< [C] vertex of each face corner
  std::vector<Vec2> texcoords;      ///< [T]
  std::vector<Index>
      cornerTexcoords;  ///< [C] index into texcoords or -1; empty where no face has any
  std::vector<std::string> materials;      ///< names; faces refer to them
  std::vector<Index> faceMaterial;         ///< [F] index into materials or -1
  std::vector<std::string> groups;         ///< names; faces refer to them
  std::vector<Index> faceGroup;            ///< [F] index into groups or -1
  std::vector<std::string> materialFiles;  ///< `mtllib` references, as they stood in the source

  Index faceCount() const { return static_cast<Index>(faceStart.size()) - 1; }
  Index faceSize(Index face) const { return faceStart[face + 1] - faceStart[face]; }
};

}  // namespace sweepface
