#pragma once

#include <cstddef>
#include <vector>

#include "sweepface/live_motion.hpp"

namespace sweepface {

/// Goals that wait until a late region sets out for them, in the order of their times. Where more
/// of a weight come than 120 a second, or than 63 while the first waits, some become one: the last
/// of them at the time of the first. Nothing allocates once it is made.
class LateGoals {
 public:
  struct Goal {
    double at = 0;  ///< when it sets out
    std::size_t weight = 0;
    double value = 0;
    Drive drive;
  };

  /// Where the delay, ≥ 0 s, is 0 no goal waits: none may be added.
  LateGoals(std::size_t weights, double delay);

  bool isEmpty() const noexcept { return count_ == 0; }
  /// Not before the last.
  void add(const Goal& goal) noexcept;
  /// The first, if it has set out by then.
  const Goal* due(double time) const noexcept;
  void removeFirst() noexcept;
  /// Those of a weight.
  void forget(std::size_t weight) noexcept;

 private:
  Goal& at(std::size_t k) noexcept { return ring_[(first_ + k) % ring_.size()]; }

  std::vector<Goal> ring_;
  std::size_t first_ = 0, count_ = 0;
  double apart_ = 0;  // goals of a weight, where there are many
};

}  // namespace sweepface
