#include "gltf/scene_quads.hpp"

#include "gltf/same_vertices.hpp"
#include "rig/source_quads.hpp"

namespace sweepface::gltf {

Result<SceneQuads> SceneQuads::find(const Rig& rig, const BoundScene& scene) {
  std::vector<Index> places;
  for (const Index v : scene.vertices) places.push_back(rig.source.gridVertex[v]);
  const auto same = sameVertices(scene.document, scene.parts, places);
  if (!same) return std::unexpected(same.error());
  SceneQuads quads;
  for (const Index face : faceOfQuads(rig)) {
    const Index part = scene.facePart[face];
    const Index* const corners = &rig.source.quadCorners[4 * quads.parts_.size()];
    quads.parts_.push_back(part);
    std::array<Index, 4>& vertices = quads.vertices_.emplace_back();
    if (part < 0) continue;
    const Run& run = scene.parts.runs[scene.parts.parts[part].run];
    for (int k = 0; k < 4; ++k) {
      vertices[k] = (*same)[scene.cornerVertex[corners[k]]] - static_cast<Index>(run.first);
      if (vertices[k] < 0 || vertices[k] >= static_cast<Index>(run.count))
        return fail("A quad of the face belongs to two meshes of its scene; convert it again.");
    }
  }
  return quads;
}

}  // namespace sweepface::gltf
