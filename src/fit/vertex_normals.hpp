#pragma once

#include <span>
#include <vector>

#include "sweepface/polygons.hpp"

namespace sweepface {

/// The vertex normals of one pose [points]: the sum of edge × edge over the face corners at a point
/// (`pointOf` [C]; negative: at none). Faces with more than four corners count as the quads they
/// are cut into if `quadCorners` [Q × 4] lists them (triangles repeat a face corner); otherwise the
/// product is flipped at reflex corners. On a regular grid this is the cross product of the central
/// differences, so a smooth surface through the vertices has it too; weighting by angle or by whole
/// faces differs from it by degrees on uneven meshes.
std::vector<Vec3> vertexNormals(const Polygons& polygons, std::span<const Vec3> positions,
                                std::span<const Index> pointOf, Index pointCount,
                                std::span<const Index> quadCorners);

/// The angles between such normals and those of a surface at the same points, in degrees, wherever
/// the source has a normal.
std::vector<double> normalAngles(std::span<const Vec3> source, std::span<const Vec3> surface);

}  // namespace sweepface
