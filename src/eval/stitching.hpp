#pragma once

#include <algorithm>

#include "sweepface/eval.hpp"

namespace sweepface {

constexpr Index kMostVertices = 1 << 24;

/// The most segments that this many edges of the source may be divided into.
inline Index mostSegments(Index edges) {
  constexpr Index kAnEdge = 64;
  return std::min(edges, kMostVertices / kAnEdge) * kAnEdge;
}

/// Segments along a side of a patch; 0 if the whole side is one point.
Index sideSegments(const Wireframe& wireframe, const Density& density, Index patch, int side);

/// Vertices of a tessellation with this density.
std::int64_t vertexCountOf(const Wireframe& wireframe, const Density& density);

/// Refines a density as far as the shape requires. An arc that closes on itself needs three
/// segments, and arcs that join the same two vertices need two each, or they would coincide. No
/// patch may have fewer columns or rows than its sides have segments.
void refineToShape(const Surface& surface, Density& density);

/// The vertices of the nodes, the first one inside each arc, and the first one inside the patch.
struct Numbering {
  std::span<const Index> nodes, arcs;
  Index inside = 0;
};

/// The triangles of a patch: a grid inside, surrounded by strips to the points of the four sides.
PatchMesh stitch(const Surface& surface, const Density& density, const Numbering& numbers,
                 Index patch);

}  // namespace sweepface
