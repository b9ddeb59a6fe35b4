#include "sweepface/late_goals.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {

// Half of the ring takes goals however dense they are. Beyond that, goals of a weight are at least
// `apart_` apart, so that there are at most `most` per weight, plus one for rounding.
LateGoals::LateGoals(std::size_t weights, double delay) {
  if (delay == 0) return;
  constexpr double kPerSecond = 120, kMost = 63;
  const double most = std::min(std::ceil(kPerSecond * delay), kMost);
  apart_ = delay / most;
  ring_.resize(2 * (static_cast<std::size_t>(most) + 1) * weights);
}

void LateGoals::add(const Goal& goal) noexcept {
  if (2 * count_ >= ring_.size())
    for (std::size_t k = count_; k-- > 0 && goal.at - at(k).at < apart_;)
      if (at(k).weight == goal.weight) {
        at(k).value = goal.value;
        at(k).drive = goal.drive;
        return;
      }
  at(count_++) = goal;
}

const LateGoals::Goal* LateGoals::due(double time) const noexcept {
  return count_ > 0 && ring_[first_].at <= time ? &ring_[first_] : nullptr;
}

void LateGoals::removeFirst() noexcept {
  first_ = (first_ + 1) % ring_.size();
  --count_;
}

void LateGoals::forget(std::size_t weight) noexcept {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count_; ++k)
    if (at(k).weight != weight) at(kept++) = at(k);
  count_ = kept;
}

}  // namespace sweepface
