#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "mesh/grid_mesh.hpp"

namespace sweepface {

/// The mirror image of each half-edge: the one in the image of its quad and along the image of its
/// edge, which runs the other way; -1 where the mesh has no mirror image. The mirror is a plane
/// perpendicular to one of the axes, through the middle of the bounding box. Only whole components
/// that find their image, in themselves or in another one, count as mirrored.
std::vector<HalfEdge> findMirror(const GridMesh& mesh, std::span<const Vec3> positions);

}  // namespace sweepface
