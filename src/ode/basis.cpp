#include <algorithm>
#include <cmath>

#include "sweepface/ode.hpp"

#include "ode/limits.hpp"
#include "ode/modes.hpp"

namespace sweepface {

SweepBasis::SweepBasis() : SweepBasis(0, 0) {}

SweepBasis::SweepBasis(double a, double b)
    : roots_(ode::findRoots(a, b)),
      modes_(ode::solveModes(ode::atomsAt(roots_, 1), ode::derivative(roots_),
                             ode::magnitude(roots_))) {}

Result<SweepBasis> SweepBasis::make(const Shape& shape, double length) {
  if (shape.rho == 0) return fail("rho must not be zero: it leads the sixth-order equation.");
  const auto a = ode::scaled(shape.eta, shape.rho, length, 2);
  const auto b = ode::scaled(shape.lambda, shape.rho, length, 4);
  if (!a) return std::unexpected(a.error());
  if (!b) return std::unexpected(b.error());
  const bool isSafe = *a <= 0 && *b >= 0;
  return ode::accepted(SweepBasis(*a, *b), std::sqrt(std::abs(*a) + std::sqrt(std::abs(*b))),
                       isSafe, "eta/rho <= 0 and lambda/rho >= 0");
}

std::array<double, 6> SweepBasis::at(double u, int order) const {
  u = std::clamp(u, 0.0, 1.0);
  if (order < 3 && (u == 0 || u == 1)) return ode::atEnd<3>(u, order);
  return ode::combine(modes_, ode::atomsAt(roots_, u), order);
}

TangentBasis::TangentBasis() : TangentBasis(0) {}

TangentBasis::TangentBasis(double s)
    : s_(s),
      modes_(ode::solveModes(ode::atomsAt(s, 1), ode::derivative(s),
                             std::sqrt(std::max(1.0, std::abs(s))))) {}

Result<TangentBasis> TangentBasis::make(const Shape& shape, double length) {
  if (shape.eta == 0) return fail("eta must not be zero: it leads the fourth-order equation.");
  const auto s = ode::scaled(-shape.lambda, shape.eta, length, 2);
  if (!s) return std::unexpected(s.error());
  return ode::accepted(TangentBasis(*s), std::sqrt(std::abs(*s)), *s >= 0, "lambda/eta <= 0");
}

std::array<double, 4> TangentBasis::at(double u, int order) const {
  u = std::clamp(u, 0.0, 1.0);
  if (order < 2 && (u == 0 || u == 1)) return ode::atEnd<2>(u, order);
  return ode::combine(modes_, ode::atomsAt(s_, u), order);
}

std::array<double, 2> LinearBasis::at(double u, int order) const {
  u = std::clamp(u, 0.0, 1.0);
  if (order == 0) return {1 - u, u};
  return order == 1 ? std::array{-1.0, 1.0} : std::array{0.0, 0.0};
}

}  // namespace sweepface
