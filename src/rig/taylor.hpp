#pragma once

#include <array>
#include <cmath>

namespace sweepface {

/// A function of (x, y) around a point, by its Taylor coefficients of x^i y^j, i, j ≤ 2; terms of
/// higher degree in x or in y are dropped. What is computed from jets of surfaces this way has
/// exact jets (Griewank, Walther: Evaluating Derivatives, chapter 13).
struct Taylor {
  std::array<double, 9> c{};  ///< [3i + j]

  double value() const { return c[0]; }
  /// ∂x^i ∂y^j.
  double derivative(int i, int j) const { return c[3 * i + j] * factorial(i) * factorial(j); }
  void setDerivative(int i, int j, double d) { c[3 * i + j] = d / (factorial(i) * factorial(j)); }

  Taylor& operator+=(const Taylor& b) {
    for (int k = 0; k < 9; ++k) c[k] += b.c[k];
    return *this;
  }
  Taylor& operator*=(double s) {
    for (double& x : c) x *= s;
    return *this;
  }

 private:
  static double factorial(int n) { return n == 2 ? 2 : 1; }
};

inline Taylor operator+(Taylor a, const Taylor& b) { return a += b; }
inline Taylor operator*(Taylor a, double s) { return a *= s; }
inline Taylor operator-(const Taylor& a, const Taylor& b) { return a + b * -1.0; }
inline Taylor operator+(Taylor a, double s) {
  a.c[0] += s;
  return a;
}

inline Taylor operator*(const Taylor& a, const Taylor& b) {
  Taylor product;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; i + k < 3; ++k)
        for (int l = 0; j + l < 3; ++l)
          product.c[3 * (i + k) + j + l] += a.c[3 * i + j] * b.c[3 * k + l];
  return product;
}

/// f(a) from f's first five Taylor coefficients at a's value: without its value, a is nilpotent of
/// order five.
inline Taylor compose(const std::array<double, 5>& f, Taylor a) {
  a.c[0] = 0;
  Taylor result;
  for (int k = 4; k >= 0; --k) result = result * a + f[k];
  return result;
}

/// 1/a and √a; a's value must be positive.
inline Taylor inverse(const Taylor& a) {
  const double x = 1 / a.value();
  return compose({x, -x * x, x * x * x, -x * x * x * x, x * x * x * x * x}, a);
}
inline Taylor sqrt(const Taylor& a) {
  const double x = a.value(), r = std::sqrt(x);
  return compose({r, 0.5 * r / x, -0.125 * r / (x * x), 0.0625 * r / (x * x * x),
                  -0.0390625 * r / (x * x * x * x)},
                 a);
}

}  // namespace sweepface
