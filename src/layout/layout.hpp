#pragma once

#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "mesh/grid_mesh.hpp"

namespace sweepface {

/// A patch as the grid of source quads that it covers.
struct GridPatch {
  Index m = 0, n = 0;
  std::vector<Index> vertices;    ///< [(n + 1)(m + 1)] rows of constant v
  std::vector<Index> quads;       ///< [n · m]
  std::vector<HalfEdge> bottoms;  ///< [n · m] the side of each quad that runs along +u
  Index vertex(Index i, Index j) const { return vertices[j * (m + 1) + i]; }
};

/// A wireframe on a mesh.
struct MeshWireframe {
  Wireframe wireframe;
  std::vector<Index> nodeVertices;  ///< [nodes] where they are on the mesh
};

/// Curves on a grid mesh: a set of marked edges whose regions are grids of quads.
class Layout {
 public:
  /// Marks the boundary and traces edge loops from every irregular vertex until they meet (the
  /// motorcycle graph of Eppstein et al. 2008, with chord lengths for time), then cuts rings open.
  /// If `symmetric`, lines are traced alike on both sides of a mesh that is its own mirror image.
  Layout(const GridMesh& mesh, std::span<const Vec3> positions, bool symmetric = false);

  const GridMesh& mesh() const { return mesh_; }
  /// Reads the patches off the marks. Fails if a region is not four-sided.
  Result<std::vector<GridPatch>> patches() const;
  /// The wireframe of the marks. Masks store as much as the vertices around a node can determine.
  /// Patches, nodes and arcs are numbered in the order in which patch is glued to patch, which
  /// costs files nothing. Puts `patches` in that order and turns them to keep ribbons short.
  MeshWireframe wireframe(std::vector<GridPatch>& patches) const;

  /// Cuts a patch along the grid line through column i (alongV) or row i.
  void split(const GridPatch& patch, bool alongV, Index i);
  /// Extends the line that ends at a T-vertex through the patch beyond it.
  void extend(Index vertex);

  /// The mirror image of a vertex, or -1. Marks are always set on both sides.
  Index image(Index vertex) const;

  bool isNode(Index vertex) const;
  /// Irregular vertices, crossings and boundary vertices where a line ends; not T-vertices.
  bool isFull(Index vertex) const;
  bool isRegular(Index vertex) const;
  /// Whether a grid line through a regular vertex passes from an edge to one `ratio` times as long.
  bool isUneven(Index vertex, std::span<const Vec3> positions, double ratio) const;
  /// The next vertex beyond `vertex` on the grid line from `neighbour` through it, or -1.
  Index beyond(Index vertex, Index neighbour) const;

 private:
  /// Marks the line from `vertex` through arm `arm` up to the first line it meets.
  void trace(Index vertex, int arm);
  std::span<const HalfEdge> sectors(Index v) const {
    return {ring_.data() + ringStart_[v], ring_.data() + ringStart_[v + 1]};
  }
  Index armCount(Index vertex) const {
    return static_cast<Index>(sectors(vertex).size()) + boundary_[vertex];
  }
  HalfEdge arm(Index vertex,
               int k) const;  // an outgoing half-edge, or the incoming one of a boundary
  Index target(Index vertex, int k) const;
  struct Arrival {
    Index vertex;
    int arm;  // the way back
  };
  Arrival walk(Index vertex, int k) const;
  int opposite(Index vertex, int k) const;
  bool marked(Index vertex, int k) const { return mark_[arm(vertex, k)]; }
  int marks(Index vertex) const;
  void setMark(HalfEdge h);
  /// Patches in the order in which each is glued to those before it, turned so that side 0 is the
  /// one that has waited longest.
  std::vector<GridPatch> glued(std::vector<GridPatch> patches) const;
  void buildRings();
  void traceFromIrregular(std::span<const Vec3> positions);
  void cutRings();

  const GridMesh& mesh_;
  std::vector<HalfEdge> mirror_;  // [half-edges] of the image quad on the image edge, or -1
  std::vector<char> mark_;        // [half-edges], the same on both sides of an edge
  std::vector<Index> ringStart_;  // [vertices + 1]
  std::vector<HalfEdge> ring_;    // half-edges leaving each vertex, counter-clockwise
  std::vector<char> boundary_;    // [vertices]
};

}  // namespace sweepface
