#pragma once

#include <algorithm>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Whether a face says which way is out (docs/error-metric.md on folds). One that is folded,
/// thinner than its vertices may move, or turned against the source's own normal at a corner does
/// not. Faces larger than quads may have collinear or reflex corners. `at` and `normalAt` return
/// the position and the normal of corners 0 … size − 1; `normal` is as long as twice the area.
template <typename At, typename NormalAt>
bool isSoundFace(Index size, const Vec3& normal, double tolerance, const At& at,
                 const NormalAt& normalAt) {
  double longest = 0;
  for (Index k = 0; k < size; ++k) {
    const Vec3 p = at(k), next = at((k + 1) % size) - p, before = at((k + size - 1) % size) - p;
    longest = std::max(longest, norm(next));
    const double turn = dot(cross(next, before), normal);
    if (size <= 4 && turn <= 0.05 * dot(normal, normal) / size) return false;
    if (dot(normalAt(k), normal) < 0) return false;
  }
  return norm(normal) / 2 > tolerance * longest;
}

}  // namespace sweepface
