#pragma once

#include <functional>

#include "fit/packed_poses.hpp"

namespace sweepface {

/// Finds coefficients of a pose that bring every vertex within its bound [vertices], and keeps
/// them: those in the coarsest steps that are fine enough. False if none are, or if `goesOn`, which
/// is asked now and then, says so.
bool packPose(PackedPoses& poses, Index pose, const std::vector<float>& bounds,
              const std::function<bool()>& goesOn);

}  // namespace sweepface
