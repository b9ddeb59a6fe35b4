#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/mesh.hpp"

#include "mesh/quad_pairing.hpp"

namespace sweepface {

/// Pairs of triangles that would make sound quads.
struct QuadCandidates {
  /// Judged by shapes and edge flow in the neutral; its triangles are the mesh's faces.
  PairingProblem problem;
  /// [pairs] the face corners at which the shared edge begins, in the order of the triangles.
  std::vector<std::array<Index, 2>> corners;
};

/// `copies` and `parts`: see recoverQuads. The first triangle of a pair comes earlier in the mesh.
QuadCandidates findQuadCandidates(const MeshRig& rig, std::span<const Index> copies,
                                  std::span<const Index> parts);

}  // namespace sweepface
