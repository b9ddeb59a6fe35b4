#pragma once

#include <array>
#include <cmath>
#include <span>

#include "sweepface/vec.hpp"

namespace sweepface::gltf {

/// x ↦ linear part · x + origin.
struct Affine {
  std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< columns of the linear part
  Vec3 origin;

  Vec3 direction(const Vec3& v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  Vec3 point(const Vec3& p) const { return direction(p) + origin; }
  /// The transposed linear part times v: takes normals of the image to those of the original, up to
  /// their length.
  Vec3 transposed(const Vec3& v) const {
    return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
  }
  /// Whether it reverses orientation.
  bool mirrors() const { return dot(cross(axes[0], axes[1]), axes[2]) < 0; }

  bool isFinite() const {
    for (const Vec3& axis : axes)
      if (!sweepface::isFinite(axis)) return false;
    return sweepface::isFinite(origin);
  }

  /// Whether different points become one, or nearly so: judged by the directions of the axes, not
  /// by their lengths.
  bool isSingular() const {
    const Vec3 a = normalized(axes[0]), b = normalized(axes[1]), c = normalized(axes[2]);
    return !(std::abs(dot(cross(a, b), c)) > 1e-9);
  }

  /// The inverse; this must not be singular.
  Affine inverse() const {
    // The rows of the inverse are the cross products of the columns over the determinant.
    const Vec3 x = cross(axes[1], axes[2]), y = cross(axes[2], axes[0]),
               z = cross(axes[0], axes[1]);
    const double scale = 1 / dot(axes[0], x);
    Affine result;
    result.axes = {
        {scale * Vec3{x.x, y.x, z.x}, scale * Vec3{x.y, y.y, z.y}, scale * Vec3{x.z, y.z, z.z}}};
    result.origin = -result.direction(origin);
    return result;
  }

  friend bool operator==(const Affine&, const Affine&) = default;
};

/// From a matrix as glTF has it, column by column; its last row is ignored.
inline Affine affineOf(std::span<const double, 16> m) {
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
}

/// First b, then a.
inline Affine operator*(const Affine& a, const Affine& b) {
  return {{{a.direction(b.axes[0]), a.direction(b.axes[1]), a.direction(b.axes[2])}},
          a.point(b.origin)};
}

}  // namespace sweepface::gltf
