#pragma once

#include "fit/packed_poses.hpp"

namespace sweepface {

/// Finds coefficients of a pose that bring every vertex within its bound [vertices], and keeps
/// them: those in the coarsest steps that are fine enough. False if none are.
bool packPose(PackedPoses& poses, Index pose, const std::vector<float>& bounds);

}  // namespace sweepface
