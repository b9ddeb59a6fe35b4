#pragma once

#include <vector>

#include "sweepface/eval.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/mix.hpp"
#include "gltf/slots.hpp"

namespace sweepface::gltf {

/// A tessellation as the parts of a scene see it.
struct FineMesh {
  struct Run {
    std::vector<Index> gridVertex;  ///< [vertices] of the tessellation
    std::vector<Mix> places;        ///< [vertices] in the quads of the source
  };
  std::vector<Run> runs;                      ///< [parts.runs]
  std::vector<std::vector<Index>> triangles;  ///< [parts.parts] vertices of their run
};

/// Cuts every quad of the source as the tessellation does. Vertices are shared within a run unless
/// the source's attributes differ there. `positions` are those of the tessellation; the rig must
/// know its quads.
Result<FineMesh> cutFinely(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
                           const std::vector<Vec3>& positions);

/// Gives the parts of a scene the triangles of a fine mesh, and interpolates their vertices'
/// attributes other than positions and normals. Tangents, matrices and extensions that may refer to
/// the source's vertices are left out.
Result<void> refine(BoundScene& scene, const FineMesh& mesh, Slots& slots);

}  // namespace sweepface::gltf
