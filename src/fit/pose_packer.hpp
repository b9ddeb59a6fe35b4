#pragma once

#include <functional>

#include "fit/packed_poses.hpp"

namespace sweepface {

/// Finds coefficients of a pose that bring every vertex within its bound [vertices], in the
/// coarsest steps that are fine enough, and keeps them. False if no steps are, or if `goesOn`,
/// which is polled now and then, returns false.
bool packPose(PackedPoses& poses, Index pose, const std::vector<float>& bounds,
              const std::function<bool()>& goesOn);

}  // namespace sweepface
