#pragma once

#include <array>
#include <complex>

namespace sweepface {

/// Derivatives ∂α^i ∂β^j, i, j ≤ 2, at index 3i + j, of a map of a patch corner into the plane.
using PlaneJet = std::array<std::complex<double>, 9>;

std::complex<double> onCircle(double angle);

/// The corner of a regular grid mapped into the plane around an irregular point: the characteristic
/// map of Catmull–Clark subdivision (Reif 1995; Stam 1998) for sectors of `angle`, its first spoke
/// at `start`. The map is self-similar, so it has no derivatives of its own at the centre; it is
/// interpolated at 0, `scale` and 2·`scale` in both directions. On a valence of four it is the
/// identity.
PlaneJet characteristicCorner(double start, double angle, double scale);

/// The first and second derivative of the same map along the spoke at `direction`.
std::array<std::complex<double>, 2> characteristicSpoke(double direction, double angle,
                                                        double scale);

/// A corner one of whose sides is collapsed into the centre: straight rays, turning by `turn` per
/// unit of the collapsed side. `collapsedFirst`: α runs along the collapsed side, else β does.
PlaneJet collapsedCorner(double ray, double turn, bool collapsedFirst);

}  // namespace sweepface
