#pragma once

#include <array>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// The vertices and quads of the patches at level 1, without where they are. Vertices are numbered
/// nodes first (one a point and one a T-node, in the order of nodes), then the inner ones of arcs
/// that are not collapsed, then those of patches in rows of constant v: as in Tessellation.
class LevelOne {
 public:
  explicit LevelOne(const Surface& surface);

  Index vertexCount() const { return vertices_; }
  /// Patch by patch in rows of constant v, counter-clockwise from (i, j).
  const std::vector<std::array<Index, 4>>& quads() const { return quads_; }

  /// Vertices that share an edge with each, and quads that share one with each side of each, in
  /// lists; a quad's by its sides, counter-clockwise, -1 at the boundary.
  std::vector<std::vector<Index>> vertexNeighbours() const;
  std::vector<std::vector<Index>> quadNeighbours() const;

 private:
  Index vertices_ = 0;
  std::vector<std::array<Index, 4>> quads_;
};

}  // namespace sweepface::codec
