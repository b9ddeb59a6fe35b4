#pragma once

#include <array>
#include <span>
#include <utility>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

/// Shape parameters of rho S'''''' + eta S'''' + lambda S'' = 0, per unit length.
struct Shape {
  double rho = 1, eta = 0, lambda = 0;
  friend bool operator==(const Shape&, const Shape&) = default;
};

namespace ode {

/// How the solutions are written, chosen by the roots r of the equation; see docs/mathematics.md.
enum class RootCase { Small, Close, Apart };

struct Roots {
  RootCase kind = RootCase::Small;
  double first = 0, second = 0;
  double firstTail = 0, secondTail = 0;  // what doubles leave out of oscillating roots
};

/// Coefficients of N even and N odd atoms: [order of derivative][0 even, 1 odd][end
/// condition][atom].
template <std::size_t N>
using Modes = std::array<std::array<std::array<std::array<double, N>, N>, 2>, 4>;

}  // namespace ode

/// The functions g1..g6 of the sweep S(u) = sum g_i(u) c_i, u in [0,1], where c1, c2, c3 are S, S',
/// S'' at u = 0 and c4, c5, c6 the same at u = 1.
class SweepBasis {
 public:
  /// Without tension or bending, eta = lambda = 0: the quintic Hermite polynomials.
  SweepBasis();

  /// `length` is the length h of the sweep in the units of the shape parameters: in u the equation
  /// has eta h^2 / rho and lambda h^4 / rho. Always succeeds for eta/rho <= 0 and lambda/rho >= 0;
  /// elsewhere it refuses parameters at which the basis grows large.
  static Result<SweepBasis> make(const Shape& shape, double length = 1);

  /// g1..g6 at u, or their derivatives by u of an order up to 3. The end conditions hold exactly.
  std::array<double, 6> at(double u, int order = 0) const;

 private:
  SweepBasis(double a, double b);
  ode::Roots roots_;
  ode::Modes<3> modes_;
};

/// The functions of eta S'''' + lambda S'' = 0 (rho is not used): g1, g2 belong to S, S' at u = 0
/// and g3, g4 to S, S' at u = 1.
class TangentBasis {
 public:
  /// Without lambda: the cubic Hermite polynomials.
  TangentBasis();
  /// Always succeeds for lambda/eta <= 0; elsewhere it refuses parameters at which the basis grows
  /// large.
  static Result<TangentBasis> make(const Shape& shape, double length = 1);
  std::array<double, 4> at(double u, int order = 0) const;

 private:
  explicit TangentBasis(double s);
  double s_;
  ode::Modes<2> modes_;
};

/// The functions of lambda S'' = 0, for S at u = 0 and at u = 1: straight lines.
class LinearBasis {
 public:
  std::array<double, 2> at(double u, int order = 0) const;
};

/// Parameters u of the two control curves beside a boundary curve. Measured from the boundary, so
/// negative beside the boundary at u = 1.
struct ControlSpacing {
  double u2 = 0, u3 = 0;
  friend bool operator==(const ControlSpacing&, const ControlSpacing&) = default;
};

/// First and second derivative by u across a boundary curve.
struct CrossDerivatives {
  Vec3 first, second;
  friend bool operator==(const CrossDerivatives&, const CrossDerivatives&) = default;
};

/// The derivatives of the parabola boundary + u first + u^2/2 second through two control points.
Result<CrossDerivatives> derivativesFromControls(const Vec3& boundary, const Vec3& control2,
                                                 const Vec3& control3, ControlSpacing spacing);

/// The inverse of derivativesFromControls.
std::pair<Vec3, Vec3> controlsFromDerivatives(const Vec3& boundary, const CrossDerivatives& across,
                                              ControlSpacing spacing);

/// Parameters of control curves by mean chord length, as a share of the sweep's length: positive
/// ones, to be negated beside the boundary at u = 1.
Result<ControlSpacing> spacingFromChords(std::span<const Vec3> boundary,
                                         std::span<const Vec3> control2,
                                         std::span<const Vec3> control3, double length);

}  // namespace sweepface
