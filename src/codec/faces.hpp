#pragma once

#include <algorithm>
#include <array>

#include "sweepface/polygons.hpp"

namespace sweepface::codec {

/// The corners of a quad face in order, starting with `corner`; all -1 if there is no such corner
/// or its face is not a quad.
inline std::array<Index, 4> aroundQuad(const Polygons& polygons, Index corner) {
  const auto& starts = polygons.faceStart;
  if (corner < 0 || starts.empty() || corner >= starts.back()) return {-1, -1, -1, -1};
  const auto end = std::ranges::upper_bound(starts, corner);
  const Index begin = *(end - 1), first = corner - begin;
  if (*end - begin != 4) return {-1, -1, -1, -1};
  std::array<Index, 4> around;
  for (Index k = 0; k < 4; ++k) around[k] = begin + (first + k) % 4;
  return around;
}

}  // namespace sweepface::codec
