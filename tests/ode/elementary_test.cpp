#include "ode/elementary.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace sweepface::ode {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The error in units in the last place (ulp) of the exact value.
double off(double found, long double exact) {
  const double rounded = std::abs(static_cast<double>(exact));
  return static_cast<double>(std::abs(found - exact)) /
         (std::nextafter(rounded, kInfinity) - rounded);
}

/// Calls `check` with numbers of all magnitudes up to `most`.
template <typename Check>
void forNumbers(double most, const Check& check) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 100000; ++k) {
    const double x = uniform(random) * most * std::pow(10, -8 * std::abs(uniform(random)));
    if (x != 0) check(x);
  }
}

TEST(Elementary, knowsSineAndCosineToTwoUnits) {
  forNumbers(1e5, [](double x) {
    const auto [sine, cosine] = sineCosine(x);
    EXPECT_LE(off(sine, std::sin(static_cast<long double>(x))), 2) << x;
    EXPECT_LE(off(cosine, std::cos(static_cast<long double>(x))), 2) << x;
  });
}

TEST(Elementary, knowsTheExponentialToTwoUnitsAndLessOneToThree) {
  forNumbers(700, [](double x) {
    EXPECT_LE(off(exponential(x), std::exp(static_cast<long double>(x))), 2) << x;
    EXPECT_LE(off(exponentialLess1(x), std::expm1(static_cast<long double>(x))), 3) << x;
  });
}

TEST(Elementary, knowsTheLogarithmToTwoUnits) {
  forNumbers(1e9, [](double x) {
    EXPECT_LE(off(logarithm(std::abs(x)), std::log(static_cast<long double>(std::abs(x)))), 2) << x;
  });
}

TEST(Elementary, addsToAProductWithOneRounding) {
  forNumbers(1e3, [](double x) {
    const double y = 1.1 * x + 0.3, nearly = -x * y;
    EXPECT_EQ(productPlus(x, y, nearly), std::fma(x, y, nearly));
  });
}

TEST(Elementary, isFiniteWhereItCanBe) {
  EXPECT_EQ(exponential(-kInfinity), 0);
  EXPECT_EQ(exponential(-800), 0);
  EXPECT_EQ(exponential(kInfinity), kInfinity);
  EXPECT_EQ(exponential(800), kInfinity);
  EXPECT_GT(exponential(-744), 0);  // subnormal
  EXPECT_EQ(exponentialLess1(-800), -1);
  EXPECT_NEAR(exponentialLess1(709.5) / std::exp(709.5), 1, 1e-13);
  EXPECT_EQ(exponentialLess1(0), 0);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -kInfinity);
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  EXPECT_EQ(sineCosine(1e300).cosine, 1);
  EXPECT_TRUE(std::isnan(sineCosine(kInfinity).sine));
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
  EXPECT_TRUE(std::isnan(logarithm(-1)));
}

}  // namespace
}  // namespace sweepface::ode
