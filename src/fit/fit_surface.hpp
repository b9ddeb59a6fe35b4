#pragma once

#include <limits>

#include "fit/conversion_progress.hpp"
#include "fit/refine.hpp"

namespace sweepface {

/// A layout's draft with the vectors fitted to it.
struct Fitted {
  Draft draft;
  Solution solution;
};

/// How near fits come to all vertices.
struct FitReach {
  bool isBeyond = false;  ///< the last fit failed as it could not keep its promise
  double nearest = std::numeric_limits<double>::infinity();  ///< the largest distance, the least of
                                                             ///< all fits
};

/// Refines a layout until the surface is within the limits at every vertex. The limit on distance
/// is a promise, the one on normals an aim: once refinement stalls, only the promise counts.
/// Finally, ribbons may get shape parameters that bring the surface nearer. `reach` goes on from
/// what earlier fits of the same source reached.
Result<Fitted> fitSurface(Layout& layout, SourceData& data, const RefineLimits& limits,
                          bool choosesShapes, ConversionProgress& progress, FitReach& reach);

}  // namespace sweepface
