// A truncated singular value decomposition by deflation: one mode after the other is found by power
// iteration and taken away from what is left. A target whose remainder is small enough everywhere
// takes no further part, so that later modes serve those that still need them.
//
// Sums are taken in a fixed order: the tables are the same on every machine.
#include "eval/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
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
        targets_(left.targets),
        squared_(tolerance * tolerance),
        unfinished_(left.targets),
        mode_(left.rows) {
    found_.modesOf.assign(left.targets, 0);
    std::iota(unfinished_.begin(), unfinished_.end(), 0);
  }

  LowRank run() {
    while (found_.modes < left_.rows) {
      measure();
      letGo();
      if (unfinished_.empty() || !findMode(worstColumn())) break;
      takeMode();
    }
    return std::move(found_);
  }

 private:
  /// Squares of what is left: summed over rows, and the largest of a row.
  void measure() {
    sums_.assign(left_.columns(), 0.0f);
    most_.assign(left_.targets, 0.0f);
    for (int r = 0; r < left_.rows; ++r) {
      const float* row = left_.row(r);
      for (int c = 0; c < left_.columns(); ++c) sums_[c] += row[c] * row[c];
      for (int k = 0; k < left_.targets; ++k) {
        const float* x = row + 3 * k;
        most_[k] = std::max(most_[k], x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
      }
    }
  }

  /// Takes out the columns of targets that are near enough.
  void letGo() {
    kept_.clear();
    for (int k = 0; k < left_.targets; ++k)
      if (most_[k] > squared_) kept_.push_back(k);
    const int before = left_.columns();
    if (3 * static_cast<int>(kept_.size()) == before) return;
    float* to = left_.values.data();
    for (int r = 0; r < left_.rows; ++r) {
      const float* row = left_.values.data() + static_cast<std::size_t>(r) * before;
      for (const int k : kept_) to = std::copy_n(row + 3 * k, 3, to);
    }
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      unfinished_[i] = unfinished_[kept_[i]];
      std::copy_n(sums_.begin() + 3 * kept_[i], 3, sums_.begin() + 3 * i);
    }
    unfinished_.resize(kept_.size());
    left_.targets = static_cast<int>(kept_.size());
  }

  int worstColumn() const {
    return static_cast<int>(std::max_element(sums_.begin(), sums_.begin() + left_.columns()) -
                            sums_.begin());
  }

  void project() {
    coefficients_.assign(left_.columns(), 0.0f);
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
    const std::size_t first = found_.coefficients.size();
    found_.coefficients.resize(first + 3 * static_cast<std::size_t>(targets_));
    ++found_.modes;
    for (std::size_t i = 0; i < unfinished_.size(); ++i) {
      found_.modesOf[unfinished_[i]] = found_.modes;
      std::copy_n(coefficients_.begin() + 3 * i, 3,
                  found_.coefficients.begin() + first + 3 * unfinished_[i]);
    }
  }

  Differences& left_;  // of the targets that are not finished
  int targets_;
  float squared_;
  LowRank found_;
  std::vector<int> unfinished_, kept_;
  std::vector<float> mode_, coefficients_, sums_, most_;
};

}  // namespace

LowRank factorise(Differences differences, float tolerance) {
  return Deflation(differences, tolerance).run();
}

}  // namespace sweepface
