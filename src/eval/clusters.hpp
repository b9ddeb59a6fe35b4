#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Points cut into groups of `size` (the last may be smaller) that are near each other: halved
/// along their longest extent again and again.
std::vector<std::vector<Index>> cluster(std::span<const Vec3> points, Index size);

}  // namespace sweepface
