#pragma once

#include "sweepface/drawing.hpp"

namespace sweepface::drawing {

/// Gives the faces of a surface's grid the materials of their patches, numbered in order of
/// appearance.
void addMaterials(SourceMesh& grid, const Surface& surface, const Drawing& drawing);

}  // namespace sweepface::drawing
