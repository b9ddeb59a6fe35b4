#pragma once

#include <cmath>

namespace sweepface::testing {

/// The greater of two numbers, or NaN if either is NaN, which std::max may lose.
inline double greater(double a, double b) { return b > a || std::isnan(b) ? b : a; }

}  // namespace sweepface::testing
