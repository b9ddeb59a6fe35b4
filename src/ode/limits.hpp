#pragma once

#include <cmath>
#include <string_view>

#include "sweepface/result.hpp"

#include "ode/power.hpp"

// Which parameters are refused, and what the refusal says.
namespace sweepface::ode {

/// Near a resonance of oscillating solutions the basis amplifies every error in the data, so no
/// function may exceed `largestValue` on the grid. The grid has six points per period at
/// `largestRoot`.
constexpr double largestValue = 10, largestRoot = 1000;
constexpr int gridSteps = 1024;

// snprintf would be a tenth of what a browser has to load.
inline TextPart number(double x) {
  return x < 1e9 ? TextPart(static_cast<long>(std::ceil(x))) : TextPart("more than 1000000000");
}

/// A parameter divided by the leading one and rescaled from lengths to u in [0,1].
inline Result<double> scaled(double parameter, double leading, double length, int exponent) {
  const double value = parameter / leading * ode::power(length, exponent);
  if (!(length > 0)) return fail("The length of a sweep must be a positive number.");
  if (std::isfinite(value) && std::isfinite(leading) && std::isfinite(length)) return value;
  return fail("The shape parameters and the length must be finite, also after scaling.");
}

/// The largest absolute value of any function on the grid; not finite if any value is not.
template <typename Basis>
double largestOnGrid(const Basis& basis) {
  double largest = 0;
  for (int i = 0; i <= gridSteps && std::isfinite(largest); ++i)
    for (const double g : basis.at(double(i) / gridSteps))
      if (!(std::abs(g) <= largest)) largest = std::abs(g);
  return largest;
}

/// The basis, or why it is refused. `root` bounds the roots; a safe basis never resonates.
template <typename Basis>
Result<Basis> accepted(const Basis& basis, double root, bool isSafe, std::string_view safe) {
  for (const double g : basis.at(0.5, 3))
    if (!std::isfinite(g)) return fail("The shape parameters are too large, or meet a resonance.");
  if (isSafe) return basis;
  if (root > largestRoot)
    return fail("The solutions oscillate too fast to be checked: use ", safe,
                ", or smaller parameters or a shorter length (roots near ", number(root),
                ", at most ", number(largestRoot), ").");
  const double largest = largestOnGrid(basis);
  if (largest <= largestValue) return basis;
  return fail("The shape parameters are close to a resonance: use ", safe,
              ", or other parameters (a basis function reaches ", number(largest), ", at most ",
              number(largestValue), ").");
}

}  // namespace sweepface::ode
