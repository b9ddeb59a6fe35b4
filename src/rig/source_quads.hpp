#pragma once

#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The face of each corner [C].
std::vector<Index> facesOfCorners(const Polygons& polygons);

/// Whether the face says which corners of its source lie round the quads of level 1: a file may
/// come without them.
bool knowsQuads(const Rig& rig);

/// The source's face on each of these quads, in the order of `SourceMesh::quadCorners`; empty where
/// nobody knows.
std::vector<Index> faceOfQuads(const Rig& rig);

}  // namespace sweepface
