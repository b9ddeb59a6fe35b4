#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The numbers 0, 1, 2 ... grouped by key, ascending within each group; by counting sort.
class Groups {
 public:
  /// Keys are below `groups`; a number with a negative key is in no group.
  Groups(std::span<const Index> keys, std::size_t groups);
  std::span<const Index> of(Index key) const {
    return {all_.data() + first_[key], all_.data() + first_[key + 1]};
  }

 private:
  std::vector<Index> first_, all_;
};

}  // namespace sweepface
