#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// How far the faces of a mesh lean from the normals of their vertices: the median. A surface that
/// follows all vertices and has their normals must make up for it in between.
struct Coarseness {
  double degrees = 0;  ///< from the mean normal of a face's vertices
  double height = 0;   ///< how far a face stands out across its width, in model units
};
Coarseness coarsenessOf(const PolygonMesh& mesh);

}  // namespace sweepface
