#pragma once

#include <span>
#include <vector>

#include "sweepface/render_mesh.hpp"

namespace sweepface {

/// Duplicates the vertices at which triangles with mirrored texture coordinates meet others, as no
/// tangent serves both. The mirrored triangles get the copies, which come after all vertices.
void splitMirrored(RenderMesh& mesh);

/// The tangent space of normal maps at the vertices of a render mesh: MikkTSpace's tangents. A
/// vertex of triangles with and without mirrored texture coordinates (splitMirrored) has those of
/// the side with the larger angle.
struct Tangents {
  /// [vertices] unit length, perpendicular to the normal, along u of the texture coordinates; zero
  /// where no triangle defines it.
  std::vector<Vec3> directions;
  /// [vertices] ±1: sign · normal × tangent is the bitangent, along v upwards.
  std::vector<float> signs;
};

/// The tangents of a mesh whose points are at `positions` and have these unit normals, both
/// [points].
Tangents tangentsOf(const RenderMesh& mesh, std::span<const Vec3> positions,
                    std::span<const Vec3> normals);

/// The tangents of the neutral's mesh with its own normals. `mesh` is as made by renderSource
/// (level 0, for which `grid` is at level 1), renderGrid or renderDensity.
Tangents neutralTangents(const Rig& rig, const Tessellation& grid, const RenderMesh& mesh,
                         Index level);

}  // namespace sweepface
