#pragma once

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// The source mesh of a model that was not converted from one: the surface's own grid, every curve
/// cut into its edges; quads, and triangles at collapsed sides. Faces come patch by patch.
SourceMesh gridSource(const Surface& surface);

/// Replaces polygons that a rig does not know by those of its surface. Loose vertices stay.
void takeFacesOfSurface(Rig& rig);

/// Checks that a tessellation can take the place of a level of detail, which is then 0.
Result<void> checkGrid(const Rig& rig, const Tessellation& grid, Index lod);

/// Makes the vertices and triangles of a tessellation with a density the rig's source. From then on
/// `SourceMesh::gridVertex` refers to that tessellation.
void takeMeshOf(Rig& rig, const Tessellation& grid);

}  // namespace sweepface
