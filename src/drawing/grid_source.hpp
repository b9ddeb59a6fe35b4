#pragma once

#include "sweepface/rig.hpp"

namespace sweepface::drawing {

/// The source mesh of a model that was not converted from one: the surface's own grid, every curve
/// cut into its edges; quads, and triangles at collapsed sides.
SourceMesh gridSource(const Surface& surface);

}  // namespace sweepface::drawing
