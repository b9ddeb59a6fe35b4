#pragma once

#include <algorithm>
#include <cmath>

#include "ode/atoms.hpp"

// Turns atoms into the basis functions of the end conditions; N conditions at each end.
namespace sweepface::ode {

template <std::size_t N>
double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

template <std::size_t N>
std::array<double, N> times(const std::array<double, N>& row, const Matrix<N>& m) {
  std::array<double, N> product{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) product[j] += row[i] * m[i][j];
  return product;
}

/// Row c of the result solves m x = column c of `right`, by elimination with pivoting.
template <std::size_t N>
Matrix<N> solutions(Matrix<N> m, Matrix<N> right) {
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < N; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    std::swap(m[k], m[pivot]);
    std::swap(right[k], right[pivot]);
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < N; ++j) m[i][j] -= factor * m[k][j];
      for (std::size_t c = 0; c < N; ++c) right[i][c] -= factor * right[k][c];
    }
  }
  Matrix<N> x{};
  for (std::size_t c = 0; c < N; ++c)
    for (std::size_t k = N; k-- > 0;) x[c][k] = (right[k][c] - dot(m[k], x[c])) / m[k][k];
  return x;
}

/// Half of the even and of the odd solutions for which, at u = 1, the derivative of one order below
/// N is 1 and the others are 0; with their derivatives. `scale` is about the largest |r|.
template <std::size_t N>
Modes<N> solveModes(const Atoms<N>& end, const Derivative<N>& d, double scale) {
  Modes<N> modes{};
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const auto isEven = [&](std::size_t order) { return (order + parity) % 2 == 0; };
    Matrix<N> m{}, right{};
    for (std::size_t i = 0; i < N; ++i) {
      std::array<double, N> atom{};
      atom[i] = 1;
      double unit = 1;
      for (std::size_t order = 0; order < N; ++order, unit /= scale) {
        m[order][i] = unit * dot(atom, isEven(order) ? end.even : end.odd);
        right[order][order] = unit / 2;
        atom = times(atom, isEven(order) ? d.ofEven : d.ofOdd);
      }
    }
    modes[0][parity] = solutions(m, right);
    for (std::size_t order = 1; order < 4; ++order)
      for (std::size_t c = 0; c < N; ++c)
        modes[order][parity][c] =
            times(modes[order - 1][parity][c], isEven(order - 1) ? d.ofEven : d.ofOdd);
  }
  return modes;
}

/// The N functions of the end u = 0, then those of u = 1. By symmetry, an even and an odd solution
/// with the same derivative of some order at u = 1 have opposite ones at u = 0.
template <std::size_t N>
std::array<double, 2 * N> combine(const Modes<N>& modes, const Atoms<N>& atoms, int order) {
  std::array<double, 2 * N> g{};
  const auto& [evens, odds] = modes[order];
  const bool even = order % 2 == 0;
  for (std::size_t c = 0; c < N; ++c) {
    const double e = dot(evens[c], even ? atoms.even : atoms.odd);
    const double o = dot(odds[c], even ? atoms.odd : atoms.even);
    g[c] = c % 2 == 0 ? e - o : o - e;
    g[N + c] = e + o;
  }
  return g;
}

/// The exact values that the end conditions demand at u = 0 or 1, where rounding would open seams.
template <std::size_t N>
std::array<double, 2 * N> atEnd(double u, int order) {
  std::array<double, 2 * N> g{};
  g[(u > 0 ? N : 0) + order] = 1;
  return g;
}

}  // namespace sweepface::ode
