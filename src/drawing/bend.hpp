#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::drawing {

/// The stored vectors of a pose [storedCount].
using Pose = std::vector<Vec3>;

/// Positions that weighted sums of a surface's vectors should take, in every pose.
struct Wishes {
  std::vector<std::vector<Term>> sums;
  std::vector<std::vector<Vec3>> places;  ///< [poses][sums]
};

/// The drawn length and width of a patch, in mean lengths of curves.
struct PatchSize {
  double u = 0, v = 0;
};

/// Finds the stored vectors that are not `known` [storedCount]. They satisfy the wishes by least
/// squares, and where those say nothing the surface bends least. `poses` hold the known vectors and
/// receive the others; the result is linear in the known vectors and the wishes. `sizes` [patches].
Result<void> bendLeast(const Surface& surface, const std::vector<PatchSize>& sizes,
                       const std::vector<bool>& known, const Wishes& wishes,
                       std::vector<Pose>& poses);

}  // namespace sweepface::drawing
