#pragma once

#include <span>
#include <vector>

#include "sweepface/render_mesh.hpp"

namespace sweepface {

/// What normal maps are relative to, at the vertices of a render mesh: MikkTSpace's tangents, but
/// that no vertex is doubled: where triangles with mirrored texture coordinates share one, they are
/// those of the side with the larger angle there.
struct Tangents {
  /// [vertices] unit length, perpendicular to the normal, along u of the texture coordinates; zero
  /// where no triangle tells.
  std::vector<Vec3> directions;
  /// [vertices] ±1: sign · normal × tangent is the bitangent, along v upwards.
  std::vector<float> signs;
};

/// Of a mesh whose points are at `positions` and have these unit normals, both [points].
Tangents tangentsOf(const RenderMesh& mesh, std::span<const Vec3> positions,
                    std::span<const Vec3> normals);

}  // namespace sweepface
