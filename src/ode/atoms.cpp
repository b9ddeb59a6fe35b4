#include "ode/atoms.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface::ode {
namespace {

// Power series about the middle converge to the last bit within seriesTerms up to |r|^2 = 16.
constexpr double smallSquare = 16;
constexpr int seriesTerms = 14;

struct Wave {
  double even, odd;
};

// cosh(r t) and sinh(r t)/r for r^2 = s. Growing ones are divided by e^(r/2), their value at the
// ends; the distance to the nearer end keeps boundary layers exact.
Wave wave(double s, double u) {
  const double t = u - 0.5;
  if (s == 0) return {1, t};
  const double r = std::sqrt(std::abs(s));
  if (s < 0) return {std::cos(r * t), std::sin(r * t) / r};
  const double end = std::min(u, 1 - u);
  const double decay = 0.5 * std::exp(-r * end), rest = std::expm1(-r * (1 - 2 * end));
  return {decay * (2 + rest), std::copysign(decay * rest / r, t)};
}

// (cosh(r t) - 1)/s and (sinh(r t)/r - t)/s: what is left of a wave beside {1, t}, however small s.
Wave bend(double s, double u) {
  const double t = u - 0.5;
  double even = 0, odd = 0, term = 1;
  for (int k = 2; k <= 2 * seriesTerms; k += 2, term *= s) {
    term *= t * t / ((k - 1) * k);
    even += term;
    odd += term * t / (k + 1);
  }
  return {even, odd};
}

bool isSmall(double s) { return std::abs(s) <= smallSquare; }
Wave apart(double s, double u) { return isSmall(s) ? bend(s, u) : wave(s, u); }

// G_m(t) = sum h_k t^(2k+m)/(2k+m)!, m = 2..5, of which each is the derivative of the next.
Atoms<3> series(double a, double b, double u) {
  const double t = u - 0.5;
  double h = 1, previous = 0, power = t * t / 2;
  std::array<double, 4> g{};
  for (int k = 0; k < seriesTerms; ++k) {
    double term = power;
    for (int m = 0; m < 4; ++m) {
      g[m] += h * term;
      term *= t / (2 * k + m + 3);
    }
    power *= t * t / ((2 * k + 3) * (2 * k + 4));
    previous = std::exchange(h, -a * h - b * previous);
  }
  return {{1, g[0], g[2]}, {t, g[1], g[3]}};
}

}  // namespace

Roots findRoots(double a, double b) {
  const double root = std::sqrt(std::abs(b)), discriminant = a * a / 4 - b;
  // s = r^2, the larger first; the smaller by division, where a difference would cancel.
  const double s1 = -a / 2 - std::copysign(std::sqrt(std::max(discriminant, 0.0)), a);
  if (discriminant < 0 ? isSmall(root) : isSmall(s1)) return {RootCase::Small, a, b};
  // r = p + q and p - q: p^2 and q^2 are real for b >= 0.
  const double p = (-a / 2 + root) / 2, q = (-a / 2 - root) / 2;
  // Two waves of real s differ by a factor of about e^|q|: together they are a pair, further
  // apart each stands for itself.
  const bool isPair = b >= 0 && (discriminant <= 0 || std::min(std::abs(p), std::abs(q)) < 1.5);
  if (isPair) return {RootCase::Close, p, q};
  return {RootCase::Apart, s1, b / s1};
}

double magnitude(const Roots& roots) {
  const auto [kind, first, second] = roots;
  const double square = kind == RootCase::Small ? smallSquare : std::abs(first) + std::abs(second);
  return std::sqrt(std::max(1.0, square));
}

Atoms<3> atomsAt(const Roots& roots, double u) {
  const auto [kind, first, second] = roots;
  if (kind == RootCase::Small) return series(first, second, u);
  if (kind == RootCase::Close) {
    const auto [pEven, pOdd] = wave(first, u);
    const auto [qEven, qOdd] = wave(second, u);
    return {{1, pEven * qEven, pOdd * qOdd}, {u - 0.5, pOdd * qEven, pEven * qOdd}};
  }
  const auto [even1, odd1] = apart(first, u);
  const auto [even2, odd2] = apart(second, u);
  return {{1, even1, even2}, {u - 0.5, odd1, odd2}};
}

Derivative<3> derivative(const Roots& roots) {
  const auto [kind, first, second] = roots;
  const Matrix<3> same{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (kind == RootCase::Small) return {{{{}, {1, -first, -second}, {0, 1, 0}}}, same};
  if (kind == RootCase::Close)
    return {{{{}, {0, first, second}, {0, 1, 1}}}, {{{1}, {0, 1, second}, {0, 1, first}}}};
  const double t1 = isSmall(first), t2 = isSmall(second);
  return {{{{}, {t1, first, 0}, {t2, 0, second}}}, same};
}

Atoms<2> atomsAt(double s, double u) {
  const auto [even, odd] = apart(s, u);
  return {{1, even}, {u - 0.5, odd}};
}

Derivative<2> derivative(double s) {
  return {{{{}, {isSmall(s) ? 1.0 : 0.0, s}}}, {{{1, 0}, {0, 1}}}};
}

}  // namespace sweepface::ode
