#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Three corners of a polygon, counted from 0.
using Triangle = std::array<Index, 3>;

/// Cuts a polygon into its n − 2 triangles, which keep its winding: one corner after another that
/// sticks out and holds no other, the one with the shortest cut first.
std::vector<Triangle> triangulate(std::span<const Vec3> polygon);

}  // namespace sweepface
