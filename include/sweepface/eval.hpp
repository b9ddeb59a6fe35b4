#pragma once

#include <span>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// The surface as a mesh of quads: every arc cut into `level` times its source edge count. A vertex
/// on an arc is computed once, from the arc, and shared by index, so that no level has a crack.
///
/// Vertices are numbered nodes first, then arcs' interiors, then patches' interiors. At level 1
/// there is exactly one vertex for every welded source vertex.
class Tessellation {
 public:
  Tessellation(const Surface& surface, Index level);

  Index level() const { return level_; }
  Index vertexCount() const { return static_cast<Index>(sites_.size()); }
  /// The vertex at column i ≤ level·edgesU and row j ≤ level·edgesV of a patch.
  Index vertex(Index patch, Index i, Index j) const;
  /// A site at which a vertex lies; vertices on arcs and nodes lie on several.
  const Site& site(Index vertex) const { return sites_[vertex]; }
  /// Faces [F], patch by patch in rows of constant v: four vertices, counter-clockwise from (i, j);
  /// two neighbours are equal where a side is collapsed.
  std::vector<std::array<Index, 4>> faces() const;

  /// What a vertex is made of: the six vectors of its arc or the 36 of its patch, and their
  /// weights. They are the same in every pose.
  struct Terms {
    std::span<const Index> vectors;
    std::span<const double> factors;
  };
  Terms terms(Index vertex) const;

  /// Positions of all vertices [vertexCount] of a settled pose. Linear in `vectors`.
  void positions(std::span<const Vec3> vectors, std::span<Vec3> out) const;
  std::vector<Vec3> positions(std::span<const Vec3> vectors) const;
  /// The surface's own unit normals [vertexCount].
  void normals(std::span<const Vec3> vectors, std::span<Vec3> out) const;
  std::vector<Vec3> normals(std::span<const Vec3> vectors) const;

 private:
  Index sideVertex(Index patch, int side, Index steps) const;
  void placeArcs();
  void placePatches();

  const Surface* surface_;
  Index level_;
  std::vector<Index> nodeVertex_;   // [nodes]
  std::vector<Index> arcVertex_;    // [arcs] first interior vertex
  std::vector<Index> patchVertex_;  // [patches] first interior vertex
  std::vector<Site> sites_;
  Index onArcs_ = 0;                             // vertices of nodes and arcs come first
  std::vector<Surface::ArcWeights> arcWeights_;  // [onArcs_]
  std::vector<Surface::Weights> patchWeights_;   // [vertexCount - onArcs_]
};

/// A line through points of a CurveNetwork.
struct Curve {
  HalfArc along = -1;         ///< the arc it is or lies beside, as seen from the patch on its left
  std::vector<Index> points;  ///< in the arc's own direction or, on its other side, against it
};

/// The curves that carry a pose, as lines. Beside every boundary curve lie two control curves in
/// each patch, at 1/10 and at 1/4 of the way across: the parabola from the boundary through them
/// has the surface's first and second derivative there.
struct CurveNetwork {
  std::vector<Vec3> points;     ///< model units
  std::vector<Index> nodes;     ///< points where boundary curves meet; they share them
  std::vector<Curve> boundary;  ///< one an arc that is not collapsed
  std::vector<Curve> control;   ///< two a half-arc with a patch
};

/// The curves of a settled pose with `perEdge` ≥ 1 points on every source edge.
CurveNetwork curveNetwork(const Surface& surface, std::span<const Vec3> vectors, Index perEdge);

/// Vertices in the source's own order [V] and their normals.
std::vector<Vec3> sourcePositions(const Rig& rig, const Tessellation& level1,
                                  std::span<const Vec3> vectors, std::span<const double> weights);
std::vector<Vec3> sourceNormals(const Rig& rig, const Tessellation& level1,
                                std::span<const Vec3> vectors);

}  // namespace sweepface
