#pragma once

#include <array>
#include <complex>

namespace sweepface {

/// Derivatives ∂α^i ∂β^j, i, j ≤ 2, at index 3i + j, of a map of a patch corner into the plane.
using PlaneJet = std::array<std::complex<double>, 9>;

std::complex<double> onCircle(double angle);

/// The corner of a regular grid mapped into the plane around an irregular point: the characteristic
/// map of Catmull–Clark subdivision (Reif 1995; Stam 1998) for sectors of `angle`, its first spoke
/// at `start`. The map is self-similar, so it has no derivatives of its own at the centre; these
/// are derivatives of its interpolant at 0, `scale` and 2·`scale` in both directions. For valence
/// four the map is the identity.
PlaneJet characteristicCorner(double start, double angle, double scale);

/// The first and second derivative of the same map along the spoke at `direction`.
std::array<std::complex<double>, 2> characteristicSpoke(double direction, double angle,
                                                        double scale);

/// A corner with one side collapsed into the centre: straight rays that turn by `turn` per unit of
/// the collapsed side. If `collapsedFirst`, α runs along that side, otherwise β does.
PlaneJet collapsedCorner(double ray, double turn, bool collapsedFirst);

}  // namespace sweepface
