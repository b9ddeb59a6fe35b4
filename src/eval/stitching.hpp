#pragma once

#include <algorithm>

#include "sweepface/eval.hpp"

namespace sweepface {

constexpr Index kMostVertices = 1 << 24;

/// As finely as so many edges of the source are cut.
inline Index mostSegments(Index edges) {
  constexpr Index kAnEdge = 64;
  return std::min(edges, kMostVertices / kAnEdge) * kAnEdge;
}

/// Segments along a side of a patch; none where all of it is one point.
Index sideSegments(const Wireframe& wireframe, const Density& density, Index patch, int side);

/// Vertices of a tessellation with this density.
std::int64_t vertexCountOf(const Wireframe& wireframe, const Density& density);

/// Makes a density as fine as it must be: an arc that closes on itself has three segments and arcs
/// that join the same two vertices have two, or they would fall together; and no patch has fewer
/// columns or rows than its sides have segments.
void refineToShape(const Surface& surface, Density& density);

/// The vertices of nodes, the first inside every arc and the first inside a patch.
struct Numbering {
  std::span<const Index> nodes, arcs;
  Index inside = 0;
};

/// The triangles of a patch: a grid inside, and around it strips to the points of the four sides.
PatchMesh stitch(const Surface& surface, const Density& density, const Numbering& numbers,
                 Index patch);

}  // namespace sweepface
