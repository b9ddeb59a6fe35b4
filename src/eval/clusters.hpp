#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Divides points into groups of `size` (the last may be smaller) that are near each other, by
/// repeatedly halving them along their longest extent.
std::vector<std::vector<Index>> cluster(std::span<const Vec3> points, Index size);

}  // namespace sweepface
