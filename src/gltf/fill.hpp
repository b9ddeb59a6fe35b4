#pragma once

#include "gltf/bound_scene.hpp"
#include "gltf/slots.hpp"
#include "mesh/morph_shapes.hpp"

namespace sweepface::gltf {

/// How a mesh holds its vertices: as floats, or as 16-bit shares of a cube.
struct Encoding {
  bool quantized = false;
  Vec3 middle;      ///< of the cube, in the mesh's space
  double half = 1;  ///< of the cube's edge; differences are shares of it too
};

/// [runs][vertices] the place of each vertex among those of the shapes.
using Places = std::vector<std::vector<Index>>;

/// Gives the parts of a scene their positions, normals and morph targets. With `morphNormals` every
/// target gets normals, otherwise only those that had them. Fails if the file outgrows a GLB.
Result<void> fill(BoundScene& scene, const MorphShapes& shapes, const Places& places,
                  const std::vector<Encoding>& encodings, bool morphNormals, Builder& builder,
                  Slots& slots);

}  // namespace sweepface::gltf
