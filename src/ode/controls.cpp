#include <cmath>

#include "sweepface/ode.hpp"

namespace sweepface {
namespace {

double meanDistance(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += norm(b[i] - a[i]);
  return sum / double(a.size());
}

bool isUsable(ControlSpacing spacing) {
  return std::isfinite(spacing.u2) && std::isfinite(spacing.u3) && spacing.u2 != 0 &&
         spacing.u3 != 0 && spacing.u2 != spacing.u3;
}

}  // namespace

Result<CrossDerivatives> derivativesFromControls(const Vec3& boundary, const Vec3& control2,
                                                 const Vec3& control3, ControlSpacing spacing) {
  if (!isUsable(spacing))
    return fail("The control curves must have different finite parameters other than zero.");
  if (!isFinite(boundary) || !isFinite(control2) || !isFinite(control3))
    return fail("The boundary and control points must have finite coordinates.");
  // Divided differences: the slopes of the chords, then their rate of change.
  const auto [u2, u3] = spacing;
  const Vec3 slope2 = (control2 - boundary) * (1 / u2), slope3 = (control3 - boundary) * (1 / u3);
  const Vec3 half = (slope3 - slope2) * (1 / (u3 - u2));
  const CrossDerivatives across{slope2 - half * u2, half * 2};
  if (isFinite(across.first) && isFinite(across.second)) return across;
  return fail("The control curves are too close to each other or to the boundary for derivatives.");
}

std::pair<Vec3, Vec3> controlsFromDerivatives(const Vec3& boundary, const CrossDerivatives& across,
                                              ControlSpacing spacing) {
  const auto at = [&](double u) { return boundary + (across.first + across.second * (u / 2)) * u; };
  return {at(spacing.u2), at(spacing.u3)};
}

Result<ControlSpacing> spacingFromChords(std::span<const Vec3> boundary,
                                         std::span<const Vec3> control2,
                                         std::span<const Vec3> control3, double length) {
  if (boundary.empty() || control2.size() != boundary.size() || control3.size() != boundary.size())
    return fail("The boundary and both control curves must have the same number of points.");
  if (!(length > 0) || !std::isfinite(length))
    return fail("The length of a sweep must be positive and finite.");
  const double u2 = meanDistance(boundary, control2) / length;
  const double u3 = u2 + meanDistance(control2, control3) / length;
  if (!std::isfinite(u3)) return fail("The curves must have finite coordinates.");
  if (u2 > 0 && u3 > u2) return ControlSpacing{u2, u3};
  return fail("Both control curves must lie apart from the curve before them.");
}

}  // namespace sweepface
