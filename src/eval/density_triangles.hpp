#pragma once

#include <algorithm>
#include <array>

#include "sweepface/eval.hpp"

namespace sweepface {

/// A place i of m and j of n steps from the first corner of a quad of level 1, or beyond the quad.
struct QuadPlace {
  std::size_t quad = 0;  ///< as SourceMesh::quadCorners counts
  std::int64_t i = 0;
  Index m = 1;
  std::int64_t j = 0;
  Index n = 1;
};

/// A triangle of a tessellation with a density.
struct DensityTriangle {
  std::size_t middle = 0;  ///< the quad at its centroid
  std::array<Index, 3> vertices{};
  std::array<QuadPlace, 3> places{};
};

/// Sees places of a patch from quads that a seam does not part from them.
template <typename AreJoined>
class QuadWalk {
 public:
  /// `areJoined(a, b, next)` tells whether no seam runs between quad a and b, the next in its row
  /// or column, which lies beyond a's corners `next` and 2.
  QuadWalk(const AreJoined& areJoined, std::size_t firstQuad, Index columns)
      : areJoined_(areJoined), first_(firstQuad), columns_(columns) {}

  /// A place as seen from the quad at a column and row: in the quad where it lies or, where a seam
  /// is in the way, beyond the last one before the seam.
  QuadPlace seen(Index column, Index row, const PatchMesh::Point& point) const {
    std::size_t quad = first_ + static_cast<std::size_t>(row) * columns_ + column;
    for (int turn = 0; turn < 2; ++turn) {  // once more, around the end of a seam
      follow(quad, column, point.u, 1, 1);
      follow(quad, row, point.v, columns_, 3);
    }
    return {quad, steps(point.u, column), point.u.of, steps(point.v, row), point.v.of};
  }

 private:
  void follow(std::size_t& quad, Index& at, const Place& goal, Index stride, int next) const {
    while (goal.value() > at + 1 && areJoined_(quad, quad + stride, next)) quad += stride, ++at;
    while (goal.value() < at && areJoined_(quad - stride, quad, next)) quad -= stride, --at;
  }
  static std::int64_t steps(const Place& place, Index from) {
    return std::int64_t{place.whole - from} * place.of + place.step;
  }

  const AreJoined& areJoined_;
  std::size_t first_;
  Index columns_;
};

/// Calls `visit(triangle)` for every triangle of a tessellation with a density, patch by patch,
/// that has three different vertices. All three places are seen from the triangle's middle;
/// `areJoined` is QuadWalk's.
template <typename AreJoined, typename Visit>
void forEachTriangle(const Surface& surface, const Tessellation& grid, const AreJoined& areJoined,
                     Visit visit) {
  std::size_t first = 0;
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const Index m = surface.edgesU(p), n = surface.edgesV(p);
    const QuadWalk walk(areJoined, first, m);
    const PatchMesh mesh = grid.patchMesh(p);
    for (const auto& corners : mesh.triangles) {
      const auto vertexAt = [&](int k) { return mesh.points[corners[k]].vertex; };
      if (vertexAt(0) == vertexAt(1) || vertexAt(1) == vertexAt(2) || vertexAt(2) == vertexAt(0))
        continue;
      double u = 0, v = 0;
      for (const Index k : corners)
        u += mesh.points[k].u.value() / 3, v += mesh.points[k].v.value() / 3;
      const Index column = std::min(static_cast<Index>(u), m - 1),
                  row = std::min(static_cast<Index>(v), n - 1);
      DensityTriangle triangle{.middle = first + static_cast<std::size_t>(row) * m + column};
      for (int k = 0; k < 3; ++k) {
        const PatchMesh::Point& point = mesh.points[corners[k]];
        triangle.vertices[k] = point.vertex;
        triangle.places[k] = walk.seen(column, row, point);
      }
      visit(triangle);
    }
    first += static_cast<std::size_t>(m) * n;
  }
}

}  // namespace sweepface
