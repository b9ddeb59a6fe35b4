#pragma once

#include <algorithm>

namespace sweepface {

/// The default tolerance, as a share of the diagonal.
inline constexpr double kDefaultTolerance = 0.0002;

/// The usual limit on normals for a tolerance, in degrees: 2.8 at the default tolerance.
inline double usualNormalLimit(double tolerance, double diagonal) {
  return std::clamp(2.8 * tolerance / (kDefaultTolerance * diagonal), 2.0, 60.0);
}

/// The neutral's step, as a share of packing's tolerance, for vectors that few vertices follow; the
/// hierarchy makes the steps of others finer.
inline constexpr double kNeutralStep = 0.25;

/// The angle that packing aims at, as a share of the limit on normals.
inline constexpr double kAngleShare = 0.2;

}  // namespace sweepface
