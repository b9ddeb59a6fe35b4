#pragma once

#include <algorithm>

#include "sweepface/surface.hpp"

namespace sweepface {

/// The direction from a half-arc into the patch on its left.
struct Inward {
  int side = 0;          ///< the side of the patch on which the half-arc lies
  bool alongV = false;   ///< inward is along v, else along u
  double direction = 1;  ///< 1 if inward is towards larger u or v, else -1
  double edges = 1;      ///< the length of the patch in that direction

  Inward(const Surface& surface, HalfArc h) {
    const Index patch = surface.connectivity().patchOf[h];
    while (std::ranges::count(surface.wireframe().side(patch, side), h) == 0) ++side;
    alongV = side == 0 || side == 2;
    direction = side == 0 || side == 3 ? 1 : -1;
    edges = alongV ? surface.edgesV(patch) : surface.edgesU(patch);
  }
};

}  // namespace sweepface
