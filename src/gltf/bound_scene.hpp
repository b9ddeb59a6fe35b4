#pragma once

#include "sweepface/rig.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A glTF with the parts of a rig in it, and how their vertices and faces correspond to the rig's.
struct BoundScene {
  Document document;
  Parts parts;
  std::vector<Index> targets;       ///< [parts.targets] the rig's target of each, or -1
  std::vector<Index> vertices;      ///< [parts.vertexCount] the source's vertex of each
  std::vector<Index> cornerVertex;  ///< [face corners] which of those vertices is at each
  std::vector<Index> facePart;      ///< [faces] in parts.parts
};

/// [nodes] the mesh in parts.meshes that each node shows, or -1.
std::vector<Index> shownMeshes(const BoundScene& scene);

/// The scene that came with a rig, with room for new targets. Fails if the two do not fit.
Result<BoundScene> sceneOf(const Rig& rig);

/// A scene of one mesh made from a rig's polygons: a primitive for every material, and the vertices
/// in their order, followed by copies where texture coordinates differ. `positions` are the
/// neutral's.
Result<BoundScene> sceneOfPolygons(const Rig& rig, const std::vector<Vec3>& positions);

}  // namespace sweepface::gltf
