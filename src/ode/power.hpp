#pragma once

namespace sweepface::ode {

/// base^exponent by multiplication. Exponents here are small whole numbers, and std::pow answers
/// differently from library to library.
constexpr double power(double base, int exponent) {
  double product = 1;
  for (int k = exponent < 0 ? -exponent : exponent; k > 0; --k) product *= base;
  return exponent < 0 ? 1 / product : product;
}

}  // namespace sweepface::ode
