#pragma once
#include <span>
#include <vector>

#include "sweepface/mesh.hpp"

#include "mesh/quad_pairing.hpp"

namespace sweepface {

/// Two triangles that would make a sound quad.
struct QuadCandidate {
  std::array<Index, 2> corners;  ///< where the shared edge begins, in the triangle that stands
                                 ///< first and in the other
};

struct QuadCandidates {
  std::vector<QuadCandidate> list;
  PairingProblem problem;  ///< pairs in the order of `list`; triangles are faces
};
QuadCandidates findQuadCandidates(const MeshRig& rig, std::span<const Index> copies);
}  // namespace sweepface
