#pragma once

#include <string_view>

#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface::edit {

/// Refuses an index that is out of range.
inline Result<void> checkIndex(Index k, std::size_t count, std::string_view what) {
  if (k >= 0 && static_cast<std::size_t>(k) < count) return {};
  return fail("There is no ", what, " ", k, "; there are ", count, ".");
}

/// Refuses a rig whose targets are not decoded yet, since decoding them needs the rest of it as it
/// was.
inline Result<void> checkWhole(const Rig& rig) {
  if (rig.knowsTargets()) return {};
  return fail("The targets of the face are not decoded yet; decode them before it is edited.");
}

}  // namespace sweepface::edit
