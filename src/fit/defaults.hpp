#pragma once

#include <algorithm>

namespace sweepface {

/// The tolerance where nobody says one: of the diagonal.
inline constexpr double kDefaultTolerance = 0.0002;

/// The limit on normals that goes with a tolerance, degrees: 2.8 at the default one.
inline double usualNormalLimit(double tolerance, double diagonal) {
  return std::clamp(2.8 * tolerance / (kDefaultTolerance * diagonal), 2.0, 60.0);
}

/// The neutral's steps, of the tolerance of packing, for vectors that few vertices follow; the
/// hierarchy makes those of others finer.
inline constexpr double kNeutralStep = 0.25;

/// The angle that packing aims at, of the limit on normals.
inline constexpr double kAngleShare = 0.2;

}  // namespace sweepface
