#pragma once

#include <algorithm>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Distance from a point to the segment between a and b, which may coincide.
inline double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a;
  const double square = dot(way, way);
  const double s = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
  return norm(p - (a + s * way));
}

/// Distance from a point to a triangle, which may be degenerate (Ericson, Real-Time Collision
/// Detection, 5.1.5).
inline double distanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return norm(ap);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return norm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return norm(ap - ab * (d1 - d3 > 0 ? d1 / (d1 - d3) : 0));
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return norm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return norm(ap - ac * (d2 - d6 > 0 ? d2 / (d2 - d6) : 0));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double sum = d4 - d3 + d5 - d6;
    return norm(bp - (c - b) * (sum > 0 ? (d4 - d3) / sum : 0));
  }
  const double sum = va + vb + vc;
  return norm(p - (a + ab * (vb / sum) + ac * (vc / sum)));
}

}  // namespace sweepface
