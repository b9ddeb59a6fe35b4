#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/polygons.hpp"

namespace sweepface {

/// Three corners of a polygon, counted from 0.
using Triangle = std::array<Index, 3>;

/// Where the corners of a face are.
std::vector<Vec3> cornerPositions(const Polygons& polygons, std::span<const Vec3> positions,
                                  Index face);

/// A polygon's normal, as long as twice its area seen along it; zero where there is none.
Vec3 meanNormal(std::span<const Vec3> polygon);

/// Cuts a polygon into its n − 2 triangles, which keep its winding: one corner after another that
/// sticks out and holds no other, the one with the shortest cut first.
std::vector<Triangle> triangulate(std::span<const Vec3> polygon);

}  // namespace sweepface
