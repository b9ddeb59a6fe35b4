#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// A vector in steps.
using Steps3 = std::array<std::int32_t, 3>;
inline bool isMoved(const Steps3& v) { return (v[0] | v[1] | v[2]) != 0; }
/// Roughly how many bits it takes to code a vector where `expected` is predicted.
inline double bitsOf(const Steps3& v, const Steps3& expected = {}) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += 2 * std::log2(1.0 + std::abs(v[k] - expected[k]));
  return sum;
}
/// The stored vectors of a pose [S] less their predictions, in steps.
using Coefficients = std::vector<Steps3>;

/// A coefficient of a pose that is not zero.
struct Moved {
  Index vector;
  Steps3 steps;
};
using Sparse = std::vector<Moved>;

/// What the coefficients of a pose are compared with before they are coded.
enum class Symmetry {
  none,    ///< with nothing
  self,    ///< with the mirror image of its own half that came before
  partner  ///< with the mirror image of an earlier pose
};

/// The value of a vector according to its mirror image `v`.
inline Steps3 reflected(Steps3 v, int sign, int axis) {
  for (int k = 0; k < 3; ++k)
    if ((k == axis) == (sign > 0)) v[k] = -v[k];
  return v;
}

/// Most steps of a coefficient: far more than any face needs, yet sums of a few still fit.
inline constexpr std::int32_t kFarthest = 1 << 26;

/// Converts a vector to steps that are 2^finer times smaller, or larger if `finer` is negative.
inline Steps3 inFinerSteps(Steps3 v, int finer) {
  for (std::int32_t& x : v) {
    const std::int64_t y =
        finer >= 0 ? x * (std::int64_t{1} << std::min(finer, 30)) : x >> std::min(-finer, 30);
    x = static_cast<std::int32_t>(std::clamp<std::int64_t>(y, -kFarthest, kFarthest));
  }
  return v;
}

}  // namespace sweepface::codec
