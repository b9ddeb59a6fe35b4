#pragma once

#include "fit/conversion_progress.hpp"
#include "fit/refine.hpp"

namespace sweepface {

/// A layout's draft with the vectors that were fitted to it.
struct Fitted {
  Draft draft;
  Solution solution;
};

/// Refines a layout until the surface is within the limits at every vertex. That on distance is a
/// promise, that on normals an aim: once refinement stalls, only the promise counts. In the end
/// ribbons may get shape parameters that bring the surface nearer.
Result<Fitted> fitSurface(Layout& layout, SourceData& data, const RefineLimits& limits,
                          bool choosesShapes, ConversionProgress& progress);

}  // namespace sweepface
