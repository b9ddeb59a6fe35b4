#pragma once

#include <span>

#include "codec/hierarchy.hpp"

namespace sweepface::codec {

/// Predicts what targets add to the positions of sites that are no roots from the nearest sites
/// before them, by where they stand in the neutral [S]; all else goes by the lines of `hierarchy`.
/// What a target does is taken for a random field whose values differ the more the further apart
/// two sites are, as the power 1.5 of the distance; ways that sites face count as `turned` times
/// the difference of their normals. The weights are those of the least expected error that sum to 1
/// (kriging with an unknown mean: Matheron, Principles of Geostatistics, 1963).
Prediction predictMoves(const Surface& surface, const Hierarchy& hierarchy,
                        std::span<const Vec3> neutral, double turned);

}  // namespace sweepface::codec
