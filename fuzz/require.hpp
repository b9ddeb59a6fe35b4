#pragma once

#include <cstdlib>

namespace sweepface::fuzzing {

/// Aborts if a property does not hold, which is what a fuzzer looks for.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace sweepface::fuzzing
