#pragma once

#include "sweepface/picture.hpp"

namespace sweepface {

/// A tint for every patch, such that no two patches that share an arc have the same.
std::vector<Colour> patchTints(const Surface& surface);

/// Boundary and control curves as strokes.
std::vector<Stroke> wireStrokes(const Surface& surface, std::span<const Vec3> vectors);
/// Boundary curves in the colours of their joins.
std::vector<Stroke> joinStrokes(const Surface& surface, std::span<const Vec3> vectors);

/// The meanings of the curves' colours.
std::vector<Key> wireLegend();
std::vector<Key> joinLegend(const Surface& surface);

}  // namespace sweepface
