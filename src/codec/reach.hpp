#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::codec {

/// How far one unit of each vector [V] moves the surface: what it does to the corners of patches,
/// by the largest values of the basis there, and to what is derived from it.
std::vector<double> reachOf(const Surface& surface);

/// Two values an octave: no rounding in the last digit can tip them.
double roundedReach(double reach);

}  // namespace sweepface::codec
