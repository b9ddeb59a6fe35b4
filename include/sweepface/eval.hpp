#pragma once

#include <span>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// How finely a surface is cut: the number of segments of every arc, and of columns and rows inside
/// every patch. An arc has one number for both its patches, so that they meet without cracks or
/// T-junctions, however different they are.
struct Density {
  std::vector<Index> arcs;                    ///< [arcs] at least 1
  std::vector<std::array<Index, 2>> patches;  ///< [patches] columns and rows: at least 1, and no
                                              ///< fewer than on the sides
};

/// What a level of detail may cost or must achieve.
struct Budget {
  enum class Kind {
    edgeLength,  ///< no arc has a segment longer than this, in model units
    error,       ///< no edge of a triangle is further than this from the surface at its middle, in
                 ///< model units, nor an arc from its segments, measured at seven points of each
                 ///< (one, where an edge is cut into more than four). Triangles are at most
                 ///< a little further (on the ICT head an eighth, with eyes and teeth half)
    vertices     ///< as close to the surface as this many vertices allow
  };
  Kind kind = Kind::vertices;
  double value = 0;
};
/// The length that is `pixels` long on screen at a distance, as the error of a Budget. The camera
/// has a vertical field of view in radians, the picture a height in pixels.
double errorOnScreen(double pixels, double distance, double fieldOfView, double height);

/// The density for a budget, measured on a settled pose. The same pose gives the same density
/// everywhere. An edge of the source is cut into 64 at most, even where that is too few for a
/// length or an error. Fails if the patches have more corners than vertices are allowed, if more
/// than 2^24 would be needed, or if the budget is not positive.
Result<Density> densityFor(const Surface& surface, std::span<const Vec3> vectors,
                           const Budget& budget);

/// A coordinate in source edges: whole + step / of, 0 ≤ step < of.
struct Place {
  Index whole = 0, step = 0, of = 1;
  double value() const { return whole + static_cast<double>(step) / of; }
};

/// The triangles of one patch.
struct PatchMesh {
  struct Point {
    Index vertex = -1;
    Place u, v;
  };
  std::vector<Point> points;
  std::vector<std::array<Index, 3>> triangles;  ///< of points, counter-clockwise
};

/// The surface as a mesh of quads: every arc cut into `level` times its source edge count. A vertex
/// on an arc is computed once, from the arc, and shared by index, so that no level has a crack.
///
/// Vertices are numbered nodes first, then arcs' interiors, then patches' interiors. At level 1
/// there is exactly one vertex for every welded source vertex.
class Tessellation {
 public:
  /// `level` is at least 1. The surface must outlive the tessellation.
  Tessellation(const Surface& surface, Index level);
  /// With a density for every arc and patch instead of a level; has triangles and no faces.
  Tessellation(const Surface& surface, Density density);
  /// The vertices are single sites, with nothing between them.
  Tessellation(const Surface& surface, std::vector<Site> sites);

  /// Whether it may belong to this surface: one with as many nodes, arcs, patches and vectors.
  bool fits(const Surface& surface) const;
  /// 0 if it has a density instead, or nothing but sites.
  Index level() const { return level_; }
  /// Whether it is of single sites. Then only vertexCount(), site(), terms(), positions() and
  /// normals() may be called.
  bool isOfSites() const { return isOfSites_; }
  Index vertexCount() const { return static_cast<Index>(sites_.size()); }
  /// The vertex at column i ≤ level·edgesU and row j ≤ level·edgesV of a patch.
  Index vertex(Index patch, Index i, Index j) const;
  /// The vertex `steps` steps along a side of a patch, counter-clockwise from its start.
  Index sideVertex(Index patch, int side, Index steps) const;
  /// A site at which a vertex lies; vertices on arcs and nodes lie on several.
  const Site& site(Index vertex) const { return sites_[vertex]; }
  /// Faces [F], patch by patch in rows of constant v: four vertices, counter-clockwise from (i, j);
  /// two neighbours are equal where a side is collapsed.
  std::vector<std::array<Index, 4>> faces() const;

  /// The same as triangles, for any density: the grid inside a patch is stitched to its sides.
  PatchMesh patchMesh(Index patch) const;
  /// Triangles of all patches in turn [T]; those with two equal vertices are left out.
  std::vector<std::array<Index, 3>> triangles() const;

  /// What a vertex is made of: the six vectors of its arc or the 36 of its patch, and their
  /// weights. They are the same in every pose.
  struct Terms {
    std::span<const Index> vectors;
    std::span<const double> factors;
  };
  Terms terms(Index vertex) const;

  /// Positions of all vertices [vertexCount] of a settled pose, [Surface::vectorCount]. Linear in
  /// `vectors`.
  void positions(std::span<const Vec3> vectors, std::span<Vec3> out) const;
  std::vector<Vec3> positions(std::span<const Vec3> vectors) const;
  /// The surface's own unit normals [vertexCount].
  void normals(std::span<const Vec3> vectors, std::span<Vec3> out) const;
  std::vector<Vec3> normals(std::span<const Vec3> vectors) const;

 private:
  void placeAll();
  void forgetPlaces();
  bool separateEdges();
  void placeArcs();
  void placePatches();
  void weighPatches();

  const Surface* surface_;
  Index level_;
  bool isOfSites_ = false;
  Index vectors_;  // of the surface
  Density density_;
  std::vector<Index> nodeVertex_;   // [nodes]
  std::vector<Index> arcVertex_;    // [arcs] first interior vertex
  std::vector<Index> patchVertex_;  // [patches] first interior vertex
  std::vector<Site> sites_;
  Index onArcs_ = 0;                                  // vertices of nodes and arcs come first
  std::vector<Surface::ArcWeights> arcWeights_;       // [onArcs_]
  std::vector<std::array<Index, 36>> patchVectors_;   // [patches], where there are vertices inside
  std::vector<std::array<double, 36>> patchFactors_;  // [vertexCount - onArcs_]
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
  std::vector<Curve> boundary;  ///< one for every arc that is not collapsed
  std::vector<Curve> control;   ///< two for every half-arc with a patch
};

/// The curves of a settled pose with `perEdge` ≥ 1 points on every source edge.
CurveNetwork curveNetwork(const Surface& surface, std::span<const Vec3> vectors, Index perEdge);

/// Positions of the vertices in the source's own order [V] and their unit normals, of a settled
/// pose [vectorCount] and a tessellation of level 1. Vertices of no face move by `weights`
/// [targets], of which missing ones are 0, and have a normal along z.
std::vector<Vec3> sourcePositions(const Rig& rig, const Tessellation& level1,
                                  std::span<const Vec3> vectors, std::span<const double> weights);
std::vector<Vec3> sourceNormals(const Rig& rig, const Tessellation& level1,
                                std::span<const Vec3> vectors);

}  // namespace sweepface
