#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sweepface/vec.hpp"

// What files with numbers of single precision can hold, and all later code relies on.
namespace sweepface::io {

/// Half a unit in a float's last place, as a share of the number: what is smaller is lost when it
/// is added to that.
inline constexpr double kHalfDigit = 0x1p-24;

inline bool isSingle(double number) {
  return std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max());
}
inline bool isSingle(const Vec2& p) { return isSingle(p.x) && isSingle(p.y); }
inline bool isSingle(const Vec3& p) { return isSingle(p.x) && isSingle(p.y) && isSingle(p.z); }

template <typename List>
bool areSingle(const List& list) {
  return std::ranges::all_of(list, [](const auto& each) { return isSingle(each); });
}

}  // namespace sweepface::io
