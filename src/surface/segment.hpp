#pragma once

#include <algorithm>

#include "sweepface/vec.hpp"

namespace sweepface {

/// How far a point is from the straight piece between a and b, which may be one point.
inline double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double square = dot(way, way);
  const double s = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
  return norm(p - (a + s * way));
}

}  // namespace sweepface
