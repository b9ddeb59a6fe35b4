#pragma once

#include "picture/colour.hpp"

namespace sweepface {

/// A point of a surface as the eye sees it.
struct SurfacePoint {
  Light colour;              ///< what it reflects
  Vec3 normal;               ///< unit, on the visible side
  bool front = true;         ///< whether the visible side is the outer one
  Vec3 toEye;                ///< unit
  double sky = 1, lamp = 1;  ///< the shares of their light that reach it
};

/// The directions of a camera's lamps: unit vectors towards them.
struct Lamps {
  explicit Lamps(const Camera& camera);
  Vec3 key, fill, rim;
};

/// Angular radius of the key lamp, radians.
inline constexpr double kKeyRadius = 0.3;

Light shade(Finish finish, const SurfacePoint& point, const Lamps& lamps);

}  // namespace sweepface
