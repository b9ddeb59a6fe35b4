#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweepface/measure.hpp"
#include "sweepface/mesh.hpp"

// The same face in other formats, for the plot of error against bytes.
namespace sweepface {

/// What a file with the shapes of a mesh rig takes, and how far off its vertices are.
struct PeerFile {
  std::string setting;
  std::size_t bytes = 0, brotliBytes = 0;  ///< the latter 0 where there is no brotli
  ErrorSummary distance, displacement;     ///< of the vertices of faces in all shapes and targets
};

struct Peers {
  PeerFile glb;                  ///< single precision; no bytes where it is left out
  std::vector<PeerFile> packed;  ///< by gltfpack, from coarse to fine
  std::string left;              ///< a sentence about what is left out and how to have it, or empty
};

/// How many steps makePeers takes.
constexpr int kPeerSteps = 4;

/// Writes the source as GLB, has it packed by `gltfpack` and measures what these decode to. Calls
/// `step` before each step, and goes no further where that refuses.
Peers makePeers(const MeshRig& source, const std::string& gltfpack,
                const std::function<Result<void>()>& step);

/// Which vertex of a rig that lost its order stands for each of the source's: of those within
/// `radius` of it in the neutral, the nearest at its worst over all shapes. -1: for vertices of no
/// face. Fails where a vertex or a target is missing.
Result<std::vector<Index>> counterparts(const MeshRig& source, const MeshRig& found, double radius);

}  // namespace sweepface
