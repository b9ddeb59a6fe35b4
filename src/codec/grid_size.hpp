#pragma once

#include <cstdint>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// Most edges of an arc and most vertices at level 1 that a file may ask for, since long arcs cost
/// next to no bytes.
inline constexpr Index kLongestArc = 65535;
inline constexpr std::int64_t kMostGridVertices = 64'000'000;

/// Whether a wireframe has at most `most` vertices at level 1.
bool isSmallEnough(const Wireframe& wireframe, std::int64_t most);

}  // namespace sweepface::codec
