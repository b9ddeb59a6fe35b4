#include "ode/atoms.hpp"

#include <algorithm>
#include <cmath>

#include "ode/elementary.hpp"

namespace sweepface::ode {
namespace {

// Up to |r|^2 = 16, power series about the middle converge to the last bit within seriesTerms.
constexpr double smallSquare = 16;
constexpr int seriesTerms = 14;

struct Wave {
  double even, odd;
};

// cosh(r t) and sinh(r t)/r for r^2 = s. Growing ones are divided by e^(r/2), their growth to the
// ends, and computed from the distance to the nearer end, which keeps boundary layers exact.
Wave wave(double s, double tail, double u) {
  const double t = u - 0.5;
  if (s == 0) return {1, t};
  const double r = std::sqrt(std::abs(s));
  if (s < 0) {
    // The phase to more digits than a double has: near a resonance its error would be amplified.
    const double phase = r * t, rest = productPlus(r, t, -phase) + tail * t;
    const auto [sine, cosine] = sineCosine(phase);
    return {cosine - rest * sine, (sine + rest * cosine) / r};
  }
  const double end = std::min(u, 1 - u);
  const double decay = 0.5 * exponential(-r * end), rest = exponentialLess1(-r * (1 - 2 * end));
  return {decay * (2 + rest), std::copysign(decay * rest / r, t)};
}

// (cosh(r t) - 1)/s and (sinh(r t)/r - t)/s: what a wave adds to {1, t}, accurate for any small s.
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
Wave apart(double s, double tail, double u) { return isSmall(s) ? bend(s, u) : wave(s, tail, u); }

// G_m(t) = sum h_k t^(2k+m)/(2k+m)!, m = 2..5. Each is the derivative of the next.
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

// An exact value as a double and the remainder.
struct Exact {
  double value, tail;
};

Exact sum(double a, double b) {
  const double s = a + b, part = s - a;
  return {s, (a - (s - part)) + (b - part)};
}

// The tail of |r| for r^2 = s < 0.
double rootTail(Exact s) {
  if (!(s.value < 0)) return 0;
  const double r = std::sqrt(-s.value);
  return (productPlus(-r, r, -s.value) - s.tail) / (2 * r);
}

Roots withTails(RootCase kind, Exact first, Exact second) {
  return {kind, first.value, second.value, rootTail(first), rootTail(second)};
}

// For b >= 0, r = p + q and p - q with real p^2, q^2 = (-a/2 +- sqrt(b)) / 2; this is one of them.
Exact closeSquare(double a, double b, double sign) {
  const double root = std::sqrt(b);
  const double rootRest = root > 0 ? productPlus(-root, root, b) / (2 * root) : 0;
  const auto [large, small] = sum(-a / 2, sign * root);
  const auto [value, tail] = sum(large, small + sign * rootRest);  // `large` may have cancelled
  return {value / 2, tail / 2};
}

// The larger and the smaller real root s (by magnitude) of s^2 + a s + b, refined by one Newton
// step beyond double precision.
Roots apartRoots(double a, double b, double s1) {
  const auto [other, otherTail] = sum(s1, a);
  const double product = s1 * other;
  const double residual = (product + b) + productPlus(s1, other, -product) + s1 * otherTail;
  const double tail1 = -residual / (s1 + other);
  const double s2 = b / s1;  // their difference would cancel
  const double tail2 = (productPlus(-s2, s1, b) - s2 * tail1) / s1;
  return withTails(RootCase::Apart, {s1, tail1}, {s2, tail2});
}

}  // namespace

Roots findRoots(double a, double b) {
  const double discriminant = a * a / 4 - b;
  const double s1 = -a / 2 - std::copysign(std::sqrt(std::max(discriminant, 0.0)), a);
  if (discriminant < 0 ? isSmall(std::sqrt(b)) : isSmall(s1)) return {RootCase::Small, a, b};
  if (b < 0) return apartRoots(a, b, s1);
  const Exact p = closeSquare(a, b, 1), q = closeSquare(a, b, -1);
  // For real s the two solutions differ by a factor of about e^|q|. Close roots are treated as a
  // pair, those further apart one by one.
  if (discriminant > 0 && std::min(std::abs(p.value), std::abs(q.value)) >= 1.5)
    return apartRoots(a, b, s1);
  return withTails(RootCase::Close, p, q);
}

double magnitude(const Roots& roots) {
  const auto [kind, first, second, firstTail, secondTail] = roots;
  const double square = kind == RootCase::Small ? smallSquare : std::abs(first) + std::abs(second);
  return std::sqrt(std::max(1.0, square));
}

Atoms<3> atomsAt(const Roots& roots, double u) {
  const auto [kind, first, second, firstTail, secondTail] = roots;
  if (kind == RootCase::Small) return series(first, second, u);
  if (kind == RootCase::Close) {
    const auto [pEven, pOdd] = wave(first, firstTail, u);
    const auto [qEven, qOdd] = wave(second, secondTail, u);
    return {{1, pEven * qEven, pOdd * qOdd}, {u - 0.5, pOdd * qEven, pEven * qOdd}};
  }
  const auto [even1, odd1] = apart(first, firstTail, u);
  const auto [even2, odd2] = apart(second, secondTail, u);
  return {{1, even1, even2}, {u - 0.5, odd1, odd2}};
}

Derivative<3> derivative(const Roots& roots) {
  const auto [kind, first, second, firstTail, secondTail] = roots;
  const Matrix<3> same{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (kind == RootCase::Small) return {{{{}, {1, -first, -second}, {0, 1, 0}}}, same};
  if (kind == RootCase::Close)
    return {{{{}, {0, first, second}, {0, 1, 1}}}, {{{1}, {0, 1, second}, {0, 1, first}}}};
  const double t1 = isSmall(first), t2 = isSmall(second);
  return {{{{}, {t1, first, 0}, {t2, 0, second}}}, same};
}

Atoms<2> atomsAt(double s, double u) {
  const auto [even, odd] = apart(s, rootTail({s, 0}), u);
  return {{1, even}, {u - 0.5, odd}};
}

Derivative<2> derivative(double s) {
  return {{{{}, {isSmall(s) ? 1.0 : 0.0, s}}}, {{{1, 0}, {0, 1}}}};
}

}  // namespace sweepface::ode
