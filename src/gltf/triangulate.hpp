#pragma once

#include <span>
#include <vector>

#include "gltf/triangles.hpp"

namespace sweepface::gltf {

/// Cuts a polygon into its n − 2 triangles of corners, which keep its winding: one corner after
/// another that sticks out and holds no other, the one with the shortest cut first.
std::vector<Triangle> triangulate(std::span<const Vec3> polygon);

}  // namespace sweepface::gltf
