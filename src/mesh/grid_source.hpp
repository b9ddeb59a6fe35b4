#pragma once

#include "sweepface/rig.hpp"

namespace sweepface {

/// The source mesh of a model that was not converted from one: the surface's own grid, every curve
/// cut into its edges; quads, and triangles at collapsed sides. Faces come patch by patch.
SourceMesh gridSource(const Surface& surface);

}  // namespace sweepface
