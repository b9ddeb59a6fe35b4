#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/grid_mirror.hpp"
#include "surface/groups.hpp"

namespace sweepface::codec {

/// What is beside each of many items, in one list.
struct Neighbours {
  std::vector<Index> first{0};  ///< [items + 1] where those of each begin
  std::vector<Index> all;

  std::size_t items() const { return first.size() - 1; }
  std::span<const Index> of(Index item) const {
    return {all.data() + first[item], all.data() + first[item + 1]};
  }
};

/// The vertices and quads of the patches at level 1, without where they are. Vertices are numbered
/// nodes first (one a point and one a T-node, in the order of nodes), then the inner ones of arcs
/// that are not collapsed, then those of patches in rows of constant v: as in Tessellation.
class LevelOne {
 public:
  LevelOne(const Surface& surface, const Mirror& mirror);

  Index vertexCount() const { return vertices_; }
  /// Patch by patch in rows of constant v, counter-clockwise from (i, j).
  const std::vector<std::array<Index, 4>>& quads() const { return quads_; }

  const GridMirror& mirror() const { return mirror_; }

  /// Vertices that share an edge with each, and quads that share one with each side of each: a
  /// quad's by its sides, counter-clockwise, -1 at the boundary.
  Neighbours vertexNeighbours() const;
  Neighbours quadNeighbours() const;

 private:
  Index vertices_ = 0;
  std::vector<std::array<Index, 4>> quads_;
  GridMirror mirror_;
};

}  // namespace sweepface::codec
