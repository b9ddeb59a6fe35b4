#include "eval/density_triangles.hpp"
#include "gltf/fine_mesh.hpp"
#include "gltf/scene_quads.hpp"

namespace sweepface::gltf {
Result<FineMesh> cutByDensity(const Rig& rig, const BoundScene& scene, const Tessellation& grid) {
  const auto quads = SceneQuads::find(rig, scene);
  if (!quads) return std::unexpected(quads.error());
  // Attributes of a part may be unknown at vertices that only another part shows.
  const auto areJoined = [&](std::size_t a, std::size_t b, int next) {
    const std::array<Index, 4>&v = quads->verticesOf(a), &w = quads->verticesOf(b);
    return quads->partOf(a) >= 0 && quads->partOf(a) == quads->partOf(b) && v[next] == w[0] &&
           v[2] == w[4 - next];
  };
  FineMeshBuilder builder(scene);
  forEachTriangle(rig.surface, grid, areJoined, [&](const DensityTriangle& triangle) {
    const Index part = quads->partOf(triangle.middle);
    if (part < 0) return;
    std::array<Index, 3> corners{};
    for (int k = 0; k < 3; ++k) {
      const auto& [quad, i, m, j, n] = triangle.places[k];
      corners[k] = builder.shared(part, triangle.vertices[k],
                                  Mix::within(quads->verticesOf(quad), i, m, j, n));
    }
    builder.addTriangle(part, corners);
  });
  return builder.take();
}

}  // namespace sweepface::gltf
