// A truncated singular value decomposition by deflation: modes are found one after another by power
// iteration and subtracted from the remainder. A target whose remainder is small enough everywhere
// drops out, so that later modes serve those that still need them.
#include "eval/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sweepface {
namespace {

class Deflation {
 public:
  Deflation(Planes& left, float tolerance)
      : left_(left),
        lane_(left.lane),
        squared_(tolerance * tolerance),
        unfinished_(left.targets),
        mode_(left.rows),
        coefficients_(left.width()),
        sums_(left.width()),
        most_(left.lane) {
    found_.modesOf.assign(left.targets, 0);
    std::iota(unfinished_.begin(), unfinished_.end(), 0);
  }

  LowRank run() {
    while (found_.modes < left_.rows) {
      measureSquares(left_, sums_.data(), most_.data());
      letGo();
      if (kept_.empty() || !findMode(worstColumn())) break;
      takeMode();
    }
    return std::move(found_);
  }

 private:
  bool normalise() {
    float squared = 0;
    for (const float x : mode_) squared += x * x;
    if (!(squared > 1e-30f)) return false;
    const float scale = 1 / std::sqrt(squared);
    for (float& x : mode_) x *= scale;
    return true;
  }

  /// Drops targets that are near enough: zeroes their columns, and removes these once the others
  /// fit into fewer registers.
  void letGo() {
    kept_.clear();
    for (int k = 0; k < left_.targets; ++k)
      if (most_[k] > squared_) kept_.push_back(k);
    if (Planes::laneOf(static_cast<int>(kept_.size())) < left_.lane) return takeOut();
    for (int k = 0; k < left_.targets; ++k) {
      if (unfinished_[k] < 0 || most_[k] > squared_) continue;
      unfinished_[k] = -1;
      for (int r = 0; r < left_.rows; ++r) zero(left_.row(r) + k);
      zero(sums_.data() + k);
    }
  }

  void zero(float* column) const {
    for (int axis = 0; axis < 3; ++axis) column[axis * left_.lane] = 0;
  }

  void takeOut() {
    const int before = left_.lane, width = left_.width();
    left_.targets = static_cast<int>(kept_.size());
    left_.lane = Planes::laneOf(left_.targets);
    float* to = left_.values.data();
    for (int r = 0; r < left_.rows; ++r)
      to = keepColumns(left_.values.data() + static_cast<std::size_t>(r) * width, before, to);
    keepColumns(sums_.data(), before, sums_.data());
    for (int i = 0; i < left_.targets; ++i) unfinished_[i] = unfinished_[kept_[i]];
    unfinished_.resize(kept_.size());
  }

  float* keepColumns(const float* from, int before, float* to) const {
    for (int axis = 0; axis < 3; ++axis, from += before) {
      for (const int k : kept_) *to++ = from[k];
      for (int k = left_.targets; k < left_.lane; ++k) *to++ = 0;
    }
    return to;
  }

  int worstColumn() const {
    return static_cast<int>(std::max_element(sums_.begin(), sums_.begin() + left_.width()) -
                            sums_.begin());
  }

  bool findMode(int column) {
    for (int r = 0; r < left_.rows; ++r) mode_[r] = left_.row(r)[column];
    if (!normalise()) return false;
    project(left_, mode_.data(), coefficients_.data());
    dotRows(left_, coefficients_.data(), mode_.data());  // one step is enough
    if (!normalise()) return false;
    project(left_, mode_.data(), coefficients_.data());
    return true;
  }

  void takeMode() {
    takeAway(left_, mode_.data(), coefficients_.data());
    found_.basis.insert(found_.basis.end(), mode_.begin(), mode_.end());
    const std::size_t first = found_.coefficients.size();
    found_.coefficients.resize(first + 3 * static_cast<std::size_t>(lane_));
    ++found_.modes;
    for (std::size_t i = 0; i < unfinished_.size(); ++i) {
      if (unfinished_[i] < 0) continue;
      found_.modesOf[unfinished_[i]] = found_.modes;
      for (int axis = 0; axis < 3; ++axis)
        found_.coefficients[first + axis * lane_ + unfinished_[i]] =
            coefficients_[axis * left_.lane + i];
    }
  }

  Planes& left_;  // remainders of the unfinished targets
  int lane_;
  float squared_;
  LowRank found_;
  std::vector<int> unfinished_;  // [columns] their targets; -1: dropped
  std::vector<int> kept_;
  std::vector<float> mode_, coefficients_, sums_, most_;
};

}  // namespace

LowRank factorise(Planes differences, float tolerance) {
  return Deflation(differences, tolerance).run();
}

}  // namespace sweepface
