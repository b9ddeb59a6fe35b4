#pragma once

#include <array>
#include <utility>

#include "sweepface/surface.hpp"

namespace sweepface {

/// A face of a tessellation with a level, and where it lies.
struct Cell {
  std::size_t face = 0;  ///< as Tessellation::faces() counts
  Index patch = 0;
  Index quad = 0;      ///< of level 1, as SourceMesh::quadCorners counts
  Index i = 0, j = 0;  ///< its column and row in the patch

  /// Column and row, within the quad, of corner k of the cell as faces() goes around it.
  std::array<Index, 2> cornerInQuad(int k, Index level) const {
    return {i % level + (k == 1 || k == 2), j % level + (k >= 2)};
  }
};

/// Calls `visit(cell)` for every cell, in the order of the faces.
template <typename Visit>
void forEachCell(const Surface& surface, Index level, Visit visit) {
  Cell cell;
  Index first = 0;  // the patch's first quad
  for (cell.patch = 0; cell.patch < surface.patchCount(); ++cell.patch) {
    const Index m = surface.edgesU(cell.patch), n = surface.edgesV(cell.patch);
    for (cell.j = 0; cell.j < level * n; ++cell.j)
      for (cell.i = 0; cell.i < level * m; ++cell.i, ++cell.face) {
        cell.quad = first + cell.j / level * m + cell.i / level;
        visit(std::as_const(cell));
      }
    first += m * n;
  }
}

}  // namespace sweepface
