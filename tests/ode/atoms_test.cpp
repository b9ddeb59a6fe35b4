#include "ode/atoms.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "greater.hpp"

namespace sweepface::ode {
namespace {

using Exactly = boost::multiprecision::cpp_bin_float_100;

struct ExactWave {
  Exactly even, odd;
};

/// cosh(r t) and sinh(r t)/r for r^2 = s, divided by e^(r/2) if they grow.
ExactWave waveOf(const Exactly& s, double u) {
  const Exactly r = sqrt(abs(s)), t = Exactly(u) - 0.5;
  if (s < 0) return {cos(r * t), sin(r * t) / r};
  const Exactly scale = exp(-r / 2);
  return {cosh(r * t) * scale, sinh(r * t) / r * scale};
}

/// What a wave of small s adds to {1, t}, per s.
ExactWave bendOf(const Exactly& s, double u) {
  const Exactly r = sqrt(abs(s)), t = Exactly(u) - 0.5;
  if (s < 0) return {(cos(r * t) - 1) / s, (sin(r * t) / r - t) / s};
  return {(cosh(r * t) - 1) / s, (sinh(r * t) / r - t) / s};
}

double worst(double a, double b, double u) {
  const Roots roots = findRoots(a, b);
  const Atoms<3> atoms = atomsAt(roots, u);
  double largest = 0;
  // Waves of r swing through one unit, their odd parts through 1/r.
  const auto compare = [&](double found, const Exactly& exact, const Exactly& unit = 1) {
    largest = testing::greater(largest, std::abs(static_cast<double>((found - exact) * unit)));
  };
  const auto rootOf = [](const Exactly& s) { return Exactly(sqrt(abs(s))); };
  if (roots.kind == RootCase::Apart) {
    const Exactly half = Exactly(a) / -2, part = sqrt(half * half - b);
    const Exactly first = a < 0 ? half + part : half - part, second = b / first;
    int k = 1;
    for (const Exactly& s : {first, second}) {
      const bool isSmall = abs(s) <= 16;
      const auto [even, odd] = isSmall ? bendOf(s, u) : waveOf(s, u);
      compare(atoms.even[k], even);
      compare(atoms.odd[k++], odd, isSmall ? Exactly(1) : rootOf(s));
    }
  } else {
    EXPECT_EQ(roots.kind, RootCase::Close);
    const Exactly middle = Exactly(a) / -4, part = sqrt(Exactly(b)) / 2;
    const Exactly s = middle + part, z = middle - part;
    const auto [pEven, pOdd] = waveOf(s, u);
    const auto [qEven, qOdd] = waveOf(z, u);
    const Exactly p = rootOf(s), q = rootOf(z);
    compare(atoms.even[1], pEven * qEven);
    compare(atoms.even[2], pOdd * qOdd, p * q);
    compare(atoms.odd[1], pOdd * qEven, p);
    compare(atoms.odd[2], pEven * qOdd, q);
  }
  return largest;
}

struct Equation {
  double a, b;
};

/// The equation whose roots r have these squares.
Equation withSquares(double s, double z) { return {-(s + z), s * z}; }

/// Checks equations, each of two numbers up to 500^2, at random places.
void expectExact(double most, Equation (*equation)(double, double)) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> large(16, 250'000), part(0, 1);
  for (int k = 0; k < 300; ++k) {
    const auto [a, b] = equation(large(random), large(random));
    const double u = 1 - (1 - part(random));  // so that u - 1/2 is exact
    ASSERT_LE(worst(a, b, u), most) << a << " " << b << " " << u;
  }
}

// A phase of 250 rounded to a double would be off by 3e-14.
TEST(Atoms, OfWavesHaveTheirPhaseToTheLastBit) {
  expectExact(2e-15, [](double s, double z) { return withSquares(-s, -z); });
}

TEST(Atoms, OfAWaveAndALayerAreExact) {
  expectExact(2e-15, [](double s, double z) { return withSquares(-s, z); });
}

TEST(Atoms, OfAWaveAndALayerOfNearlyTheSameSizeAreExact) {
  expectExact(2e-15, [](double s, double z) { return Equation{1e-7 * z, -s * s}; });
}

TEST(Atoms, OfLayersAreExact) {
  expectExact(1e-13, [](double s, double z) { return withSquares(s, z); });
}

TEST(Atoms, OfASmallAndALargeRootAreExact) {
  expectExact(2e-15, [](double s, double z) { return withSquares(-s, 1e-4 * (z - 1e5)); });
}

TEST(Atoms, OfTwoNearWavesAreExact) {
  expectExact(2e-15, [](double s, double z) { return withSquares(-s, -s - 1e-6 * z); });
}

TEST(Magnitude, IsAboutThatOfTheLargestRoot) {
  for (const double r : {5.0, 20.0, 500.0}) {
    const double s = r * r;
    for (const auto [a, b] : {withSquares(s, 1), withSquares(-s, 1), withSquares(-s, s / 2),
                              withSquares(s, s), Equation{0, s * s}})
      EXPECT_NEAR(magnitude(findRoots(a, b)) / r, 1.1, 0.15) << a << " " << b;
  }
  EXPECT_NEAR(magnitude(findRoots(0, 0)), 4, 0.1) << "the most that counts as small";
}

}  // namespace
}  // namespace sweepface::ode
