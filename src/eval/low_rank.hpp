#pragma once

#include <vector>

#include "eval/planes.hpp"

namespace sweepface {

/// Differences as a sum of modes: difference(r, k) ≈ Σ_m basis[m][r] · coefficients[m][k]. The
/// modes are orthonormal; a target uses only the first few, as many as it needs.
struct LowRank {
  int modes = 0;
  std::vector<float> basis;         ///< [modes][rows]
  std::vector<float> coefficients;  ///< [modes][3 × lane]
  std::vector<int> modesOf;         ///< [targets]
};

/// Finds roughly the fewest modes that leave no target further off than `tolerance` in any row.
LowRank factorise(Planes differences, float tolerance);

}  // namespace sweepface
