#pragma once

#include "sweepface/eval.hpp"

namespace sweepface {

/// The polygons of a tessellation with the materials, groups and texture coordinates of the source:
/// quads, and triangles where a side is collapsed. The rig must have the corners of its quads.
Polygons lodPolygons(const Rig& rig, const Tessellation& grid);

/// The triangles of a tessellation with a density, likewise.
Polygons densityPolygons(const Rig& rig, const Tessellation& grid);

}  // namespace sweepface
