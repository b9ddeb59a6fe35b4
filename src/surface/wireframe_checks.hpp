#pragma once

#include <algorithm>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Whether a set is closed downwards: with ∂x^i ∂y^j it has all lower derivatives.
inline bool isClosed(JetMask mask) {
  for (int k = 0; k < 9; ++k) {
    if (!(mask >> k & 1)) continue;
    if (k >= 3 && !(mask >> (k - 3) & 1)) return false;
    if (k % 3 > 0 && !(mask >> (k - 1) & 1)) return false;
  }
  return true;
}

/// Most arcs around a patch: whoever looks for a place on one goes along all of them.
inline constexpr Index kMostArcsAround = 4096;

/// The first arc that bounds no patch, or -1.
inline Index idleArc(const Wireframe& w) {
  std::vector<char> bounds(w.arcs.size());
  for (const HalfArc h : w.loops)
    if (h >= 0 && arcOf(h) < static_cast<Index>(bounds.size())) bounds[arcOf(h)] = 1;
  const auto idle = std::ranges::find(bounds, 0);
  return idle == bounds.end() ? -1 : static_cast<Index>(idle - bounds.begin());
}

}  // namespace sweepface
