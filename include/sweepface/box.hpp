#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The smallest axis-aligned box around what it includes.
struct Box {
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  Vec3 low{kNowhere, kNowhere, kNowhere}, high{-kNowhere, -kNowhere, -kNowhere};

  Box() = default;
  explicit Box(std::span<const Vec3> points) {
    for (const Vec3& p : points) include(p);
  }

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  bool isEmpty() const { return low.x > high.x; }

  /// Zero without points.
  Vec3 size() const { return isEmpty() ? Vec3{} : high - low; }
  Vec3 centre() const { return isEmpty() ? Vec3{} : 0.5 * (low + high); }
  /// 0, 1 or 2; the first of equally long ones.
  int longestAxis() const {
    const Vec3 s = size();
    return s.x >= std::max(s.y, s.z) ? 0 : s.y >= s.z ? 1 : 2;
  }
};

/// From corner to corner of the box around the points, 0 without points.
inline double diagonal(std::span<const Vec3> points) { return norm(Box(points).size()); }

}  // namespace sweepface
