#pragma once

#include <array>
#include <vector>

#include "gltf/bound_scene.hpp"

namespace sweepface::gltf {

/// Where the quads of a rig's source are in its scene.
class SceneQuads {
 public:
  /// The rig must know its quads. Fails if one has corners in several meshes.
  static Result<SceneQuads> find(const Rig& rig, const BoundScene& scene);

  /// The part that shows a quad, or -1.
  Index partOf(std::size_t quad) const { return parts_[quad]; }
  /// The vertices of its run at a quad's corners. Those that differ in normals only are one.
  const std::array<Index, 4>& verticesOf(std::size_t quad) const { return vertices_[quad]; }

 private:
  std::vector<Index> parts_;                    // [quads]
  std::vector<std::array<Index, 4>> vertices_;  // [quads]
};

}  // namespace sweepface::gltf
