#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/grid_mirror.hpp"
#include "surface/groups.hpp"

namespace sweepface::codec {

/// Adjacency lists of many items, stored in one array.
struct Neighbours {
  std::vector<Index> first{0};  ///< [items + 1] where each item's neighbours begin
  std::vector<Index> all;

  std::size_t items() const { return first.size() - 1; }
  std::span<const Index> of(Index item) const {
    return {all.data() + first[item], all.data() + first[item + 1]};
  }
};

/// The topology of the patches at level 1: vertices and quads, without positions. Vertices are
/// numbered as in Tessellation: first the nodes (one vertex for each point and each T-node, in the
/// order of nodes), then the inner vertices of arcs that are not collapsed, then those of patches,
/// in rows of constant v.
class LevelOne {
 public:
  LevelOne(const Surface& surface, const Mirror& mirror);

  Index vertexCount() const { return vertices_; }
  /// Patch by patch in rows of constant v, counter-clockwise from (i, j).
  const std::vector<std::array<Index, 4>>& quads() const { return quads_; }

  const GridMirror& mirror() const { return mirror_; }

  /// The vertices that share an edge with each vertex, and the quads across each side of each quad,
  /// counter-clockwise, -1 at the boundary.
  Neighbours vertexNeighbours() const;
  Neighbours quadNeighbours() const;

 private:
  Index vertices_ = 0;
  std::vector<std::array<Index, 4>> quads_;
  GridMirror mirror_;
};

}  // namespace sweepface::codec
