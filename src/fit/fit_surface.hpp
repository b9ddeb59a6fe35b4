#pragma once

#include "fit/conversion_progress.hpp"
#include "fit/refine.hpp"

namespace sweepface {

/// A layout's draft with the vectors fitted to it.
struct Fitted {
  Draft draft;
  Solution solution;
};

/// Refines a layout until the surface is within the limits at every vertex. The limit on distance
/// is a promise, the one on normals an aim: once refinement stalls, only the promise counts.
/// Finally, ribbons may get shape parameters that bring the surface nearer. `isBeyond` tells
/// whether it fails because the promise cannot be kept.
Result<Fitted> fitSurface(Layout& layout, SourceData& data, const RefineLimits& limits,
                          bool choosesShapes, ConversionProgress& progress, bool& isBeyond);

}  // namespace sweepface
