#pragma once

namespace sweepface::ode {

/// base^exponent by multiplication, for small exponents. std::pow gives different results in
/// different libraries.
constexpr double power(double base, int exponent) {
  double product = 1;
  for (int k = exponent < 0 ? -exponent : exponent; k > 0; --k) product *= base;
  return exponent < 0 ? 1 / product : product;
}

}  // namespace sweepface::ode
