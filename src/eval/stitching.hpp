#pragma once

#include "sweepface/eval.hpp"

namespace sweepface {

/// Segments along a side of a patch; none where all of it is one point.
Index sideSegments(const Wireframe& wireframe, const Density& density, Index patch, int side);

/// Makes a density as fine as it must be: an arc that closes on itself has three segments and arcs
/// that join the same two vertices have two, or they would fall together; and no patch has fewer
/// columns or rows than its sides have segments.
void refineToShape(const Surface& surface, Density& density);

}  // namespace sweepface
