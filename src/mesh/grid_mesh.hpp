#pragma once

#include <array>
#include <string>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// A half-edge of a grid mesh: 4·quad + side.
using HalfEdge = Index;
inline HalfEdge nextIn(HalfEdge h) { return (h & ~3) | ((h + 1) & 3); }
inline HalfEdge prevIn(HalfEdge h) { return (h & ~3) | ((h + 3) & 3); }
inline HalfEdge across(HalfEdge h) { return h ^ 2; }

/// The source mesh as quads only: seams welded, larger polygons cut into quads, triangles turned
/// into quads with one side collapsed into a point. A vertex is one fan of quads; around the pole
/// of a fan of triangles every ray ends at a vertex of its own, and these share one point.
struct GridMesh {
  std::vector<std::array<Index, 4>> quads;        ///< [Q] vertices, counter-clockwise
  std::vector<HalfEdge> twin;                     ///< [4Q] or -1
  std::vector<char> collapsed;                    ///< [4Q] a side that is one point
  std::vector<std::array<Index, 4>> quadCorners;  ///< [Q] face corner of the source at each vertex
  std::vector<Index> point;                       ///< [vertices]
  std::vector<Index> source;                      ///< [points] a source vertex at that place
  std::vector<Index> pointOfSource;               ///< [source vertices] or -1 where no face uses it
  double rounding = 0;  ///< largest distance of a source vertex from its point's, in any pose
  std::vector<std::string> warnings;  ///< what had to be done to the source, in sentences

  Index vertexCount() const { return static_cast<Index>(point.size()); }
  Index pointCount() const { return static_cast<Index>(source.size()); }
  Index from(HalfEdge h) const { return quads[h >> 2][h & 3]; }
  Index to(HalfEdge h) const { return from(nextIn(h)); }
};

/// Builds the grid mesh of a rig. Vertices within `rounding` of each other in all poses may be
/// merged (weldRounded()). Warns of open edges no further apart than `gap`, or not much further in
/// targets alone. Fails if a face has thousands of corners, or if no face is left.
Result<GridMesh> makeGridMesh(const MeshRig& rig, double rounding = 0, double gap = 0);

}  // namespace sweepface
