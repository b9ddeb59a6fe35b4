#pragma once

#include <cstdlib>

namespace sweepface::fuzzing {

/// What does not hold is what a fuzzer looks for.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace sweepface::fuzzing
