#pragma once

namespace sweepface::ode {

// Elementary functions to within two and a half units in the last place, from the four operations
// alone: the same bits on every machine, where C libraries differ, and a twentieth of their code.

struct SineCosine {
  double sine, cosine;
};
/// As near as that up to 2^22, then off by 2^-53 |x|; beyond 2^52 a double says nothing of its
/// phase: 0 and 1.
SineCosine sineCosine(double x);
double exponential(double x);
/// e^x − 1, also close to 0.
double exponentialLess1(double x);
/// For x > 0.
double logarithm(double x);

/// a · b + c where c is nearly −a · b: the product's own rounding error comes to light.
double productPlus(double a, double b, double c);

}  // namespace sweepface::ode
