// A truncated singular value decomposition by deflation: one mode after the other is found by power
// iteration and taken away from what is left. A target whose remainder is small enough everywhere
// takes no further part, so that later modes serve those that still need them.
//
// Sums are taken in a fixed order: the tables are the same on every machine.
#include "eval/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sweepface {
namespace {

constexpr int kPowerSteps = 1, kPartialSums = 16;

float dot(const float* a, const float* b, int count) {
  float sums[kPartialSums] = {};
  int k = 0;
  for (; k + kPartialSums <= count; k += kPartialSums)
    for (int s = 0; s < kPartialSums; ++s) sums[s] += a[k + s] * b[k + s];
  for (; k < count; ++k) sums[k % kPartialSums] += a[k] * b[k];
  for (int half = kPartialSums / 2; half > 0; half /= 2)
    for (int s = 0; s < half; ++s) sums[s] += sums[s + half];
  return sums[0];
}

void addScaled(float factor, const float* from, int count, float* to) {
  for (int k = 0; k < count; ++k) to[k] += factor * from[k];
}

bool normalise(std::span<float> vector) {
  const float squared = dot(vector.data(), vector.data(), static_cast<int>(vector.size()));
  if (!(squared > 1e-30f)) return false;
  const float scale = 1 / std::sqrt(squared);
  for (float& x : vector) x *= scale;
  return true;
}

class Deflation {
 public:
  Deflation(Differences& left, float tolerance)
      : left_(left),
        squared_(tolerance * tolerance),
        mode_(left.rows),
        coefficients_(left.columns()),
        squares_(left.columns()),
        unfinished_(left.targets, true) {
    found_.modesOf.assign(left.targets, 0);
  }

  LowRank run() {
    while (found_.modes < left_.rows) {
      const int worst = finishTargets();
      if (worst < 0 || !findMode(worst)) break;
      takeMode();
    }
    return std::move(found_);
  }

 private:
  /// Lets go of targets that are near enough; the column with the largest remainder, or -1.
  int finishTargets() {
    std::fill(squares_.begin(), squares_.end(), 0.0f);
    most_.assign(left_.targets, 0.0f);
    for (int r = 0; r < left_.rows; ++r) {
      const float* row = left_.row(r);
      for (int c = 0; c < left_.columns(); ++c) squares_[c] += row[c] * row[c];
      for (int k = 0; k < left_.targets; ++k) {
        const float* x = row + 3 * k;
        most_[k] = std::max(most_[k], x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      }
    }
    int worst = -1;
    for (int k = 0; k < left_.targets; ++k) {
      if (!unfinished_[k]) continue;
      if (most_[k] <= squared_) {
        finish(k);
        continue;
      }
      for (int c = 3 * k; c < 3 * k + 3; ++c)
        if (worst < 0 || squares_[c] > squares_[worst]) worst = c;
    }
    return worst;
  }

  void finish(int target) {
    unfinished_[target] = false;
    found_.modesOf[target] = found_.modes;
    for (int r = 0; r < left_.rows; ++r) std::fill_n(left_.row(r) + 3 * target, 3, 0.0f);
  }

  void project() {
    std::fill(coefficients_.begin(), coefficients_.end(), 0.0f);
    for (int r = 0; r < left_.rows; ++r)
      addScaled(mode_[r], left_.row(r), left_.columns(), coefficients_.data());
  }

  bool findMode(int column) {
    for (int r = 0; r < left_.rows; ++r) mode_[r] = left_.row(r)[column];
    if (!normalise(mode_)) return false;
    for (int step = 0; step < kPowerSteps; ++step) {
      project();
      for (int r = 0; r < left_.rows; ++r)
        mode_[r] = dot(left_.row(r), coefficients_.data(), left_.columns());
      if (!normalise(mode_)) return false;
    }
    project();
    return true;
  }

  void takeMode() {
    for (int r = 0; r < left_.rows; ++r)
      addScaled(-mode_[r], coefficients_.data(), left_.columns(), left_.row(r));
    found_.basis.insert(found_.basis.end(), mode_.begin(), mode_.end());
    found_.coefficients.insert(found_.coefficients.end(), coefficients_.begin(),
                               coefficients_.end());
    ++found_.modes;
    for (int k = 0; k < left_.targets; ++k)
      if (unfinished_[k]) found_.modesOf[k] = found_.modes;
  }

  Differences& left_;
  float squared_;
  LowRank found_;
  std::vector<float> mode_, coefficients_, squares_, most_;
  std::vector<char> unfinished_;
};

}  // namespace

LowRank factorise(Differences differences, float tolerance) {
  return Deflation(differences, tolerance).run();
}

}  // namespace sweepface
