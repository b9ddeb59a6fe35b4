#include "ode/elementary.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace sweepface::ode {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Exact = boost::multiprecision::cpp_bin_float_50;

/// The error in units in the last place (ulp) of the exact value.
double off(double found, const Exact& exact) {
  const double rounded = std::abs(static_cast<double>(exact));
  return std::abs(static_cast<double>(found - exact)) /
         (std::nextafter(rounded, kInfinity) - rounded);
}

/// Calls `check` with numbers of all magnitudes up to `most`.
template <typename Check>
void forNumbers(double most, const Check& check) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 50'000; ++k) {
    const double x = uniform(random) * most * std::pow(10, -8 * std::abs(uniform(random)));
    if (x != 0) check(x);
  }
}

TEST(Elementary, knowsSineAndCosineToTwoUnits) {
  forNumbers(1e5, [](double x) {
    const auto [sine, cosine] = sineCosine(x);
    EXPECT_LE(off(sine, sin(Exact(x))), 2) << x;
    EXPECT_LE(off(cosine, cos(Exact(x))), 2) << x;
  });
}

TEST(Elementary, knowsTheExponentialToTwoUnitsAndLessOneToThree) {
  forNumbers(700, [](double x) {
    EXPECT_LE(off(exponential(x), exp(Exact(x))), 2) << x;
    EXPECT_LE(off(exponentialLess1(x), expm1(Exact(x))), 3) << x;
  });
}

TEST(Elementary, knowsTheLogarithmToTwoUnits) {
  forNumbers(1e9, [](double x) {
    EXPECT_LE(off(logarithm(std::abs(x)), log(Exact(std::abs(x)))), 2) << x;
  });
}

TEST(Elementary, addsToAProductWithOneRounding) {
  forNumbers(1e3, [](double x) {
    const double y = 1.1 * x + 0.3, nearly = -x * y;
    EXPECT_EQ(productPlus(x, y, nearly), static_cast<double>(Exact(x) * y + nearly));
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
