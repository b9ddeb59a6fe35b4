#pragma once

#include <vector>

#include "sweepface/picture.hpp"

namespace sweepface {

/// A patch under some shape parameters.
struct ShapedPatch {
  double eta = 0, lambda = 0;  ///< over rho, for the whole length of the sweep
  Scene scene;
  double moved = 0;  ///< largest distance from the patch without parameters, model units
  std::vector<Vec2>
      profile;  ///< along the sweep's middle: share of the way, height above the chord
};

/// What shape parameters do to one patch: among the larger ones, that on which they show most. The
/// first of `shapes` has none. Empty if there is no patch with four sides.
struct ShapeStudy {
  Index patch = -1;
  View view;
  std::vector<ShapedPatch> shapes;
};
ShapeStudy studyShapes(const Surface& surface, std::span<const Vec3> vectors);

}  // namespace sweepface
