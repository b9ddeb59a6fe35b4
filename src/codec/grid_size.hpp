#pragma once

#include <cstdint>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// Edges of an arc, and vertices at level 1, that a file may ask for: arcs can be said to be long
/// at no cost.
inline constexpr Index kLongestArc = 65535;
inline constexpr std::int64_t kMostGridVertices = 64'000'000;

/// Whether a wireframe has at most so many vertices at level 1.
bool isSmallEnough(const Wireframe& wireframe, std::int64_t most);

}  // namespace sweepface::codec
