#pragma once

#include <string_view>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface::edit {

/// Refuses what there is none of.
inline Result<void> checkIndex(Index k, std::size_t count, std::string_view what) {
  if (k >= 0 && static_cast<std::size_t>(k) < count) return {};
  return fail("There is no ", what, " ", k, "; there are ", count, ".");
}

}  // namespace sweepface::edit
