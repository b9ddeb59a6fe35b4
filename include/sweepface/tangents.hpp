#pragma once

#include <span>
#include <vector>

#include "sweepface/render_mesh.hpp"

namespace sweepface {

/// Doubles the vertices at which triangles with mirrored texture coordinates meet others, as no
/// tangent serves both: the mirrored ones get copies, behind all vertices.
void splitMirrored(RenderMesh& mesh);

/// What normal maps are relative to, at the vertices of a render mesh: MikkTSpace's tangents. A
/// vertex of triangles with and without mirrored texture coordinates (splitMirrored) has those of
/// the side with the larger angle.
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

/// Of the neutral's mesh, with its own normals, as renderSource made it (level 0, for which `grid`
/// is at level 1) or renderGrid or renderDensity.
Tangents neutralTangents(const Rig& rig, const Tessellation& grid, const RenderMesh& mesh,
                         Index level);

}  // namespace sweepface
