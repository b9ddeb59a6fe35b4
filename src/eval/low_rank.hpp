#pragma once

#include <vector>

namespace sweepface {

/// Differences of a tile's rows for some targets: [rows][targets × 3], scaled so that 1 is what may
/// be dropped of a target in a row.
struct Differences {
  int rows = 0, targets = 0;
  std::vector<float> values;

  int columns() const { return 3 * targets; }
  float* row(int r) { return values.data() + static_cast<std::size_t>(r) * columns(); }
  const float* row(int r) const { return values.data() + static_cast<std::size_t>(r) * columns(); }
};

/// Differences as a sum of modes: difference(r, k) ≈ Σ_m basis[m][r] · coefficients[m][k]. The
/// modes are orthonormal; a target has coefficients in as many of them as it needs.
struct LowRank {
  int modes = 0;
  std::vector<float> basis;         ///< [modes][rows]
  std::vector<float> coefficients;  ///< [modes][targets × 3]
  std::vector<int> modesOf;         ///< [targets]
};

/// The fewest modes, roughly, that leave no more than `tolerance` of any target in any row.
LowRank factorise(Differences differences, float tolerance);

}  // namespace sweepface
