#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// How far one unit of each vector [V] moves the surface: directly at the corners of patches, by
/// the largest values of the basis there, and through the vectors derived from it.
std::vector<double> reachOf(const Surface& surface);

/// Rounds to two values per octave, so that a rounding error in the last digit does not matter.
double roundedReach(double reach);

}  // namespace sweepface::codec
