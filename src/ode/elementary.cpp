// Argument reduction to a short interval by split constants, the first with so few digits that its
// multiples are exact (Cody and Waite 1980), then a power series.
#include "ode/elementary.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace sweepface::ode {
namespace {

/// 2^k, provided that it is a normal number.
double powerOf2(int k) { return std::bit_cast<double>(std::uint64_t(k + 1023) << 52); }

constexpr int kFactorials = 20;
constexpr std::array<double, kFactorials> kInverseFactorial = [] {
  std::array<double, kFactorials> inverse{};
  double factorial = 1;  // all of them are exact
  for (int n = 0; n < kFactorials; ++n) inverse[n] = 1 / (factorial *= n > 0 ? n : 1);
  return inverse;
}();

/// Σ (−1)^n r^(2n) / (2n + first)!, for |r| up to a quarter of a turn.
double alternating(double r, int first) {
  double sum = 0;
  for (int n = 16 + first; n >= first; n -= 2) sum = kInverseFactorial[n] - r * r * sum;
  return sum;
}

// e^x = 2^k (1 + q).
struct Power {
  int k;
  double q;
};

Power powerOf(double x) {
  constexpr double kHigh = 0x1.62e42feep-1, kLow = 0x1.a39ef35793c76p-33;  // their sum is ln 2
  const double k = std::floor(x / std::numbers::ln2 + 0.5);
  const double high = x - k * kHigh, low = k * kLow, r = high - low;
  double q = 0;
  for (int n = 14; n > 0; --n) q = q * r + kInverseFactorial[n];
  return {static_cast<int>(k), r * q + ((high - r) - low)};
}

constexpr double kLargest = 709.7, kSmallest = -745;

}  // namespace

SineCosine sineCosine(double x) {
  constexpr double kHigh = 0x1.921fb544p+0, kMiddle = 0x1.0b4611a6p-34,
                   kLow = 0x1.3198a2e037073p-69;
  constexpr double kMost = 0x1p52;
  if (!(std::abs(x) < kMost)) return x - x == 0 ? SineCosine{0, 1} : SineCosine{x - x, x - x};
  const double turns = std::floor(x / (std::numbers::pi / 2) + 0.5);
  const double part = x - turns * kHigh, r = part - turns * kMiddle;
  const double rest = ((part - r) - turns * kMiddle) - turns * kLow;
  const double s = r * alternating(r, 1), c = alternating(r, 0);
  const double sine = s + rest * c, cosine = c - rest * s;
  switch (static_cast<std::int64_t>(turns) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double exponential(double x) {
  if (!(x <= kLargest)) return x > 0 ? 1 / (1 - std::fmin(x, 1)) : x;
  if (x < kSmallest) return 0;
  const auto [k, q] = powerOf(x);
  const int half = k / 2;  // in two steps, as the result may be subnormal
  return (1 + q) * powerOf2(half) * powerOf2(k - half);
}

double exponentialLess1(double x) {
  if (!(x < 709) || x < -50) return exponential(x) - 1;
  const auto [k, q] = powerOf(x);
  const double power = powerOf2(k);
  return power * q + (power - 1);
}

double logarithm(double x) {
  constexpr double kHigh = 0x1.62e42feep-1, kLow = 0x1.a39ef35793c76p-33;
  if (!(x > 0)) return x == 0 ? -HUGE_VAL : std::numeric_limits<double>::quiet_NaN();
  if (!(x < HUGE_VAL)) return x;
  const double up = x < 0x1p-1000 ? 0x1p60 : 1;
  const auto bits = std::bit_cast<std::uint64_t>(x * up);
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // the bits of sqrt(0.5)
  const auto k = static_cast<std::int64_t>(bits - kRootHalf) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(k) << 52)), f = m - 1;
  const double s = f / (m + 1), squared = s * s;
  double sum = 0;
  for (int n = 25; n > 1; n -= 2) sum = (sum + 2.0 / n) * squared;
  const double powers = static_cast<double>(k) - (up > 1 ? 60 : 0);
  // 2 s = f − f s: in this form the rounding of the quotient matters little.
  return powers * kHigh + (f - s * (f - sum) + powers * kLow);
}

double productPlus(double a, double b, double c) {
  const auto high = [](double x) {  // Dekker 1971
    const double split = 134217729.0 * x;
    return split - (split - x);
  };
  const double product = a * b, a1 = high(a), b1 = high(b), a2 = a - a1, b2 = b - b1;
  const double error = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
  return (product + c) + error;
}

}  // namespace sweepface::ode
