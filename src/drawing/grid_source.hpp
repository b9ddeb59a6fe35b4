#pragma once

#include "sweepface/drawing.hpp"

namespace sweepface::drawing {

/// The source mesh of a model that was not converted from one: the surface's own grid, every curve
/// cut into its edges; quads, and triangles at collapsed sides. Faces have their patch's material.
SourceMesh gridSource(const Surface& surface, const Drawing& drawing);

}  // namespace sweepface::drawing
