#pragma once

#include "fit/fit_surface.hpp"

namespace sweepface {

/// The rig of a fit, and where the source's vertices and polygons are on it.
Rig assemble(const MeshRig& source, const GridMesh& mesh, Fitted fitted);

}  // namespace sweepface
