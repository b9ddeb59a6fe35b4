#pragma once

#include <algorithm>

#include "sweepface/surface.hpp"

namespace sweepface {

/// The way from a curve into the patch on the left of a half-arc.
struct Inward {
  int side = 0;          ///< of the patch, on which the half-arc lies
  bool alongV = false;   ///< moving into the patch is moving along v, else along u
  double direction = 1;  ///< with u or v, or -1 against it
  double edges = 1;      ///< of the patch that way

  Inward(const Surface& surface, HalfArc h) {
    const Index patch = surface.connectivity().patchOf[h];
    while (std::ranges::count(surface.wireframe().side(patch, side), h) == 0) ++side;
    alongV = side == 0 || side == 2;
    direction = side == 0 || side == 3 ? 1 : -1;
    edges = alongV ? surface.edgesV(patch) : surface.edgesU(patch);
  }
};

}  // namespace sweepface
