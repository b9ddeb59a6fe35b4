#pragma once

#include <cstddef>
#include <vector>

#include "sweepface/live_motion.hpp"

namespace sweepface {

/// Goals that wait until a late region sets out for them, in the order of their times. If more than
/// 120 a second come for a weight, or more than 63 while the first waits, some are merged: the last
/// of them takes the time of the first. Allocates nothing once made.
class LateGoals {
 public:
  struct Goal {
    double at = 0;  ///< when it sets out
    std::size_t weight = 0;
    double value = 0;
    Drive drive;
  };

  /// `delay` is at least 0 s. At 0 no goal waits, and none may be added.
  LateGoals(std::size_t weights, double delay);

  bool isEmpty() const noexcept { return count_ == 0; }
  /// Its time must not be before that of the last one added.
  void add(const Goal& goal) noexcept;
  /// The first goal if it is due by then, else null.
  const Goal* due(double time) const noexcept;
  void removeFirst() noexcept;
  /// Removes the goals of a weight.
  void forget(std::size_t weight) noexcept;

 private:
  Goal& at(std::size_t k) noexcept { return ring_[(first_ + k) % ring_.size()]; }

  std::vector<Goal> ring_;
  std::size_t first_ = 0, count_ = 0;
  double apart_ = 0;  // time between goals of a weight, where there are many
};

}  // namespace sweepface
