#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sweepface {

/// Vectors of a few rows for some targets, in a plane for each coordinate: [rows][3][lane], where
/// lane is the number of targets rounded up to whole registers; the padding is 0.
struct Planes {
  int rows = 0, targets = 0, lane = 0;
  std::vector<float> values;

  Planes() = default;
  Planes(int rowCount, int targetCount) { reshape(rowCount, targetCount); }

  /// Sets everything to zero.
  void reshape(int rowCount, int targetCount) {
    rows = rowCount, targets = targetCount, lane = laneOf(targetCount);
    values.clear();
    values.resize(static_cast<std::size_t>(rows) * width());
  }
  int width() const { return 3 * lane; }
  float* row(int r) { return values.data() + static_cast<std::size_t>(r) * width(); }
  const float* row(int r) const { return values.data() + static_cast<std::size_t>(r) * width(); }

  static int laneOf(int targets) { return (targets + 7) / 8 * 8; }
};

// Loops over planes, which take by far the most time in making an Evaluator. Rows and spans are
// multiples of 8 long, and sums are taken in the same order on every machine.

struct Scaled {
  float factor;
  const float* row;
};
/// out = Σ factor · row; `out` may be one of the rows
void sumRows(std::span<const Scaled> terms, int width, float* out);
/// out = Σ_r factors[r] · row r
void project(const Planes& planes, const float* factors, float* out);
/// out[r] = row r · vector
void dotRows(const Planes& planes, const float* vector, float* out);
/// Subtracts factors[r] · vector from each row r.
void takeAway(Planes& planes, const float* factors, const float* vector);
/// Sets `sums` to the squares of each column summed over the rows [3 × lane], and `largest` to the
/// largest square of each target's vector in a row [lane].
void measureSquares(const Planes& planes, float* sums, float* largest);
/// Sets `largest` to the largest square of each target's vector in a row of `wanted` − Σ_m
/// basis[m][r] · coefficients[m] [lane]; `coefficients` is [modes][3 × lane]. Stops once one
/// exceeds `enough`, leaving the others as they are.
void measureRest(const Planes& wanted, std::span<const float> basis, const float* coefficients,
                 float enough, float* largest);
/// Clamps to within `most` of 0.
void clampAll(std::span<float> values, float most);
/// The largest absolute value, and the sum of the absolute values.
struct Extent {
  float most = 0, sum = 0;
};
Extent extentOf(std::span<const float> values);
/// Rounds values · factor to the nearest integers, which must fit 16 bits.
void roundAll(std::span<const float> values, float factor, std::int16_t* out);

}  // namespace sweepface
