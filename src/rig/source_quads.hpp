#pragma once

#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The face of each corner [C].
std::vector<Index> facesOfCorners(const Polygons& polygons);

/// Whether the rig knows which corners of its source surround the quads of level 1; a file may lack
/// them.
bool knowsQuads(const Rig& rig);

/// The source's face at each of these quads, in the order of `SourceMesh::quadCorners`; empty if
/// unknown.
std::vector<Index> faceOfQuads(const Rig& rig);

}  // namespace sweepface
