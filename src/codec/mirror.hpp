#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// The mirror image of a wireframe on itself, as far as it goes.
struct Mirror {
  std::vector<HalfArc> halfArc;  ///< [half-arcs] the one that mirrors it, or -1
  std::vector<Index> node;       ///< [nodes] or -1
};

/// Completes a mirror from pairs of half-arcs that bound mirrored patches on mirrored arcs (they
/// run in opposite directions): walking on from one is walking back from the other. Stops where the
/// two sides differ.
Mirror spreadMirror(const Wireframe& wireframe, const Connectivity& connectivity,
                    std::span<const std::array<HalfArc, 2>> seeds);

/// Where a model is mirrored: across which axis, and as few pairs as spread over all of it.
struct MirrorSeeds {
  int axis = 0;
  std::vector<std::array<HalfArc, 2>> pairs;
};
MirrorSeeds findMirror(const Surface& surface, std::span<const Vec3> neutral);

}  // namespace sweepface::codec
