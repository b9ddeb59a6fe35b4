#pragma once

namespace sweepface::ode {

// Elementary functions accurate to two and a half units in the last place, built from the four
// arithmetic operations alone: bit-identical on every machine, where C libraries differ, and a
// twentieth of their code.

struct SineCosine {
  double sine, cosine;
};
/// As accurate as that up to 2^22, then to 2^-53 |x|. Beyond 2^52 a double does not determine its
/// phase: returns 0 and 1.
SineCosine sineCosine(double x);
double exponential(double x);
/// e^x − 1, accurate near 0 too.
double exponentialLess1(double x);
/// For x > 0.
double logarithm(double x);

/// a · b + c, including the rounding error of the product, which matters where c is nearly −a · b.
double productPlus(double a, double b, double c);

}  // namespace sweepface::ode
