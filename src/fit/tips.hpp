#pragma once

#include "sweepface/surface.hpp"

#include "fit/solver.hpp"

namespace sweepface {

/// A tip is where the boundary runs into a point and out again around a single patch, as at the end
/// of a lash. The chart there takes the boundary for a smooth one. If the patch is one quad wide,
/// the slope into it, one of the chart's two, then moves no vertex, and least squares leave it
/// without a direction. Sets it to zero in every pose, so that normals are taken from inside.
void dropSlopesAtTips(const Surface& surface, Solution& solution);

}  // namespace sweepface
