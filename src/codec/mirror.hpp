#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// The mirror of a wireframe onto itself; it may be partial.
struct Mirror {
  std::vector<HalfArc> halfArc;  ///< [half-arcs] the one that mirrors it, or -1
  std::vector<Index> node;       ///< [nodes] or -1
};

/// Completes a mirror from pairs of half-arcs that bound mirrored patches on mirrored arcs (they
/// run in opposite directions): a step forwards from one is a step backwards from the other. Stops
/// where the two sides differ.
Mirror spreadMirror(const Wireframe& wireframe, const Connectivity& connectivity,
                    std::span<const std::array<HalfArc, 2>> seeds);

/// The mirror of a model: its axis, and as few pairs as spread over all of it.
struct MirrorSeeds {
  int axis = 0;
  std::vector<std::array<HalfArc, 2>> pairs;
};
MirrorSeeds findMirror(const Surface& surface, std::span<const Vec3> neutral);

}  // namespace sweepface::codec
