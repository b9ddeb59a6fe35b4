#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

// What files with numbers of single precision can hold.
namespace sweepface::io {

/// Half a unit in a float's last place, as a share of the number: what is smaller is lost when it
/// is added to that.
inline constexpr double kHalfDigit = 0x1p-24;

inline bool isSingle(double number) {
  return std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max());
}
inline bool areSingle(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, isSingle);
}

}  // namespace sweepface::io
