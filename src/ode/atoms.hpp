#pragma once

#include <array>

#include "sweepface/ode.hpp"

// The solutions of S'''''' + a S'''' + b S'' = 0 about the middle of the sweep, t = u - 1/2, where
// they separate into even ones, sums of three even atoms {1, E1, E2}, and odd ones, sums of three
// odd atoms {t, O1, O2}. A derivative maps even atoms to odd ones and back, by a constant matrix.
namespace sweepface::ode {

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

/// The atoms at one u.
template <std::size_t N>
struct Atoms {
  std::array<double, N> even, odd;
};

/// Row i holds the derivative of atom i.
template <std::size_t N>
struct Derivative {
  Matrix<N> ofEven, ofOdd;
};

/// Solves r^4 + a r^2 + b = 0 and chooses atoms that stay linearly independent for its roots.
Roots findRoots(double a, double b);

/// About the largest |r|, at least 1; used to scale equations.
double magnitude(const Roots& roots);

Atoms<3> atomsAt(const Roots& roots, double u);
Derivative<3> derivative(const Roots& roots);

/// The same for S'''' - s S'' = 0.
Atoms<2> atomsAt(double s, double u);
Derivative<2> derivative(double s);

}  // namespace sweepface::ode
