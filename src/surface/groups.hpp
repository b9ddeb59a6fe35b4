#pragma once

#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Numbers 0, 1, 2 ... by the key of each, in ascending order: counted, never compared.
class Groups {
 public:
  /// Keys are below `groups`; what has a negative one is in none.
  Groups(std::span<const Index> keys, std::size_t groups);
  std::span<const Index> of(Index key) const {
    return {all_.data() + first_[key], all_.data() + first_[key + 1]};
  }

 private:
  std::vector<Index> first_, all_;
};

}  // namespace sweepface
