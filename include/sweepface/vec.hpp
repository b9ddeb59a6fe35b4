#pragma once

#include <cmath>
#include <cstdint>

namespace sweepface {

/// Index into any array of a model; negative where there is nothing.
using Index = std::int32_t;

struct Vec2 {
  double x = 0, y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// A point or a direction in model units.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  [[gnu::always_inline]] Vec3& operator+=(const Vec3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  [[gnu::always_inline]] Vec3& operator-=(const Vec3& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  [[gnu::always_inline]] Vec3& operator*=(double s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// x, y or z, for axis 0, 1 or 2.
inline double& coordinate(Vec3& a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }
inline double coordinate(const Vec3& a, int axis) {
  return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

[[gnu::always_inline]] inline Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
[[gnu::always_inline]] inline Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
[[gnu::always_inline]] inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
[[gnu::always_inline]] inline Vec3 operator*(Vec3 a, double s) { return a *= s; }
[[gnu::always_inline]] inline Vec3 operator*(double s, Vec3 a) { return a *= s; }
[[gnu::always_inline]] inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline bool isFinite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The direction of `a`, or zero where `a` is too short to have one.
inline Vec3 normalized(const Vec3& a) {
  const double length = norm(a);
  return length > 0 ? a * (1 / length) : Vec3{};
}

/// The angle between two directions, in degrees; exact for small angles too.
inline double angleDegrees(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * (180.0 / 3.14159265358979323846);
}

}  // namespace sweepface
