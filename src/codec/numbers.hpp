#pragma once

#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// Keeps track of which numbers, from 0 on, are taken.
class Numbers {
 public:
  explicit Numbers(std::size_t count) : taken_(count, 0) {}

  Index count() const { return static_cast<Index>(taken_.size()); }
  bool has(Index number) const { return taken_[number]; }
  void take(Index number) { taken_[number] = 1; }
  /// The first free number; count() if there is none.
  Index next() {
    while (next_ < count() && has(next_)) ++next_;
    return next_;
  }

 private:
  std::vector<char> taken_;
  Index next_ = 0;
};

}  // namespace sweepface::codec
