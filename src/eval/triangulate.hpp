#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/polygons.hpp"

namespace sweepface {

/// Three corners of a polygon, or vertices, counted from 0.
using Triangle = std::array<Index, 3>;

/// The positions of a face's corners.
std::vector<Vec3> cornerPositions(const Polygons& polygons, std::span<const Vec3> positions,
                                  Index face);

/// A polygon's normal, whose length is twice the polygon's area seen along it; zero if there is
/// none.
Vec3 meanNormal(std::span<const Vec3> polygon);

/// Cuts a polygon into n − 2 triangles with its winding. One by one, cuts off convex corners whose
/// triangle contains no other corner, the one with the shortest cut first.
std::vector<Triangle> triangulate(std::span<const Vec3> polygon);

}  // namespace sweepface
