#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// Carries values at the vertices of the tessellation at level 1 over to those of a finer one of
/// the same surface, interpolating within each quad as a renderer does between corners.
template <typename Value>
std::vector<Value> interpolated(const Surface& surface, const Tessellation& level1,
                                const Tessellation& fine, std::span<const Value> values) {
  std::vector<Value> between(fine.vertexCount());
  const Index level = fine.level();
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const Index m = surface.edgesU(p), n = surface.edgesV(p);
    for (Index j = 0; j <= level * n; ++j)
      for (Index i = 0; i <= level * m; ++i) {
        const Index column = std::min(i / level, m - 1), row = std::min(j / level, n - 1);
        const double s = static_cast<double>(i) / level - column;
        const double t = static_cast<double>(j) / level - row;
        const auto at = [&](Index di, Index dj) {
          return values[level1.vertex(p, column + di, row + dj)];
        };
        between[fine.vertex(p, i, j)] =
            (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
      }
  }
  return between;
}

}  // namespace sweepface
