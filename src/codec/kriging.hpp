#pragma once

#include <span>

#include "codec/hierarchy.hpp"

namespace sweepface::codec {

/// Predicts what targets add to the positions of sites other than roots, from the nearest sites
/// before them and their positions in the neutral [S]. Everything else is predicted along the lines
/// of `hierarchy`. A target is modelled as a random field whose variogram is the distance to the
/// power 1.5; the difference of the normals, times `turned`, counts towards the distance. The
/// weights sum to 1 and minimise the expected error (kriging with an unknown mean: Matheron,
/// Principles of Geostatistics, 1963).
Prediction predictMoves(const Surface& surface, const Hierarchy& hierarchy,
                        std::span<const Vec3> neutral, double turned);

}  // namespace sweepface::codec
