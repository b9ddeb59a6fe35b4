#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Divides points into groups of at most `size` that are near each other, by repeatedly halving
/// them along their longest extent. Up to `size` points in the same place are in the same group;
/// without such points, only the last group may have fewer than `size`.
std::vector<std::vector<Index>> cluster(std::span<const Vec3> points, Index size);

}  // namespace sweepface
