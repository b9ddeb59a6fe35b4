#pragma once

#include "sweepface/surface.hpp"

#include "fit/solver.hpp"

namespace sweepface {

/// A boundary may run into a point and out again around a single patch, as at the end of a lash: a
/// tip. The chart there takes the boundary for a smooth one, so that of its two slopes the one into
/// the patch moves no vertex where the patch is one quad wide, and least squares leave it without a
/// direction. Makes it zero in every pose: normals then are those from inside.
void dropSlopesAtTips(const Surface& surface, Solution& solution);

}  // namespace sweepface
