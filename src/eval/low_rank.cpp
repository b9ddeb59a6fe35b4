// A truncated singular value decomposition by deflation: one mode after the other is found by power
// iteration and taken away from what is left. A target whose remainder is small enough everywhere
// takes no further part, so that later modes serve those that still need them.
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
      if (unfinished_.empty() || !findMode(worstColumn())) break;
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

  /// Takes out the columns of targets that are near enough.
  void letGo() {
    kept_.clear();
    for (int k = 0; k < left_.targets; ++k)
      if (most_[k] > squared_) kept_.push_back(k);
    const auto count = static_cast<int>(kept_.size());
    if (count == left_.targets) return;
    const int before = left_.lane, width = left_.width();
    left_.targets = count;
    left_.lane = Planes::laneOf(count);
    float* to = left_.values.data();
    for (int r = 0; r < left_.rows; ++r)
      to = keepColumns(left_.values.data() + static_cast<std::size_t>(r) * width, before, to);
    keepColumns(sums_.data(), before, sums_.data());
    for (int i = 0; i < count; ++i) unfinished_[i] = unfinished_[kept_[i]];
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
      found_.modesOf[unfinished_[i]] = found_.modes;
      for (int axis = 0; axis < 3; ++axis)
        found_.coefficients[first + axis * lane_ + unfinished_[i]] =
            coefficients_[axis * left_.lane + i];
    }
  }

  Planes& left_;  // of the targets that are not finished
  int lane_;
  float squared_;
  LowRank found_;
  std::vector<int> unfinished_, kept_;
  std::vector<float> mode_, coefficients_, sums_, most_;
};

}  // namespace

LowRank factorise(Planes differences, float tolerance) {
  return Deflation(differences, tolerance).run();
}

}  // namespace sweepface
