#pragma once

#include "picture/colour.hpp"

namespace sweepface {

/// A point of a surface as the eye sees it.
struct SurfacePoint {
  Light colour;              ///< what it reflects
  Vec3 normal;               ///< unit, on the side that is seen
  bool front = true;         ///< whether that is the outer side
  Vec3 toEye;                ///< unit
  double sky = 1, lamp = 1;  ///< how much reaches it
};

/// Where the lamps of a camera stand: unit directions towards them.
struct Lamps {
  explicit Lamps(const Camera& camera);
  Vec3 key, fill, rim;
};

/// The key lamp is as large as this, in radians from its middle.
inline constexpr double kKeyRadius = 0.3;

Light shade(Finish finish, const SurfacePoint& point, const Lamps& lamps);

}  // namespace sweepface
