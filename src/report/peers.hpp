#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sweepface/measure.hpp"
#include "sweepface/mesh.hpp"

// The same face in other formats, for the plot of error against bytes.
namespace sweepface {

/// The size of a file with the shapes of a mesh rig, and how far off its vertices are.
struct PeerFile {
  std::string setting;
  std::size_t bytes = 0, brotliBytes = 0;  ///< the latter 0 if there is no brotli
  ErrorSummary distance, displacement;     ///< of the vertices of faces in all shapes and targets
};

struct Peers {
  PeerFile glb;                  ///< single precision; no bytes if it is left out
  std::vector<PeerFile> packed;  ///< by gltfpack, from coarse to fine
  std::string left;              ///< a sentence on what is left out and how to get it, or empty
};

/// The number of steps of makePeers().
constexpr int kPeerSteps = 4;

/// Writes the source as GLB, packs it with `gltfpack` and measures what the files decode to. Calls
/// `step` before each step, and stops if that refuses.
Peers makePeers(const MeshRig& source, const std::string& gltfpack,
                const std::function<Result<void>()>& step);

/// For each vertex of the source, its counterpart in a rig that lost its order: of the vertices
/// within `radius` of it in the neutral, the one whose largest distance over all shapes is
/// smallest; -1 for vertices of no face. Fails if a vertex or a target is missing.
Result<std::vector<Index>> counterparts(const MeshRig& source, const MeshRig& found, double radius);

}  // namespace sweepface
