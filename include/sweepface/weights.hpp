#pragma once

#include <cmath>
#include <vector>

namespace sweepface {

/// A weight for every target.
using Weights = std::vector<double>;

/// The largest weight that a text can mean. More is a slip: 1 is the whole expression, and squares
/// of what a surface computes would not stay finite.
inline constexpr double kMostPlausibleWeight = 1e6;
inline bool isPlausibleWeight(double weight) { return std::abs(weight) <= kMostPlausibleWeight; }

}  // namespace sweepface
