#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "sweepface/ode.hpp"

#include "ode/oracle.hpp"

namespace sweepface {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool isRefused(double a, double b) { return !SweepBasis::make({1, a, b}); }

double largestByOracle(double a, double b, int places = 32) {
  const test::Oracle<72> oracle(a, b);
  double largest = 0;
  for (int i = 0; i <= places; ++i)  // the other half mirrors this half
    for (const auto state = oracle.at(0.5 * i / places); const auto& g : state[0])
      largest = std::max(largest, std::abs(g.convert_to<double>()));
  return largest;
}

// The rule: a shape is refused where a basis function exceeds 10, give or take 5% for the oracle's
// coarser grid.
void expectTheRule(double a, double b) {
  const double largest = largestByOracle(a, b);
  if (largest < 9.5 || largest > 10.5) {
    EXPECT_EQ(isRefused(a, b), largest > 10) << a << ", " << b << " reaches " << largest;
  }
}

TEST(Resonance, isRefusedWhereTheBasisGrowsLarge) {
  EXPECT_TRUE(isRefused(80.7836, 1));
  EXPECT_TRUE(isRefused(0, -3803.54));
  EXPECT_FALSE(isRefused(78, 1));
  EXPECT_FALSE(isRefused(84, 1));
  EXPECT_FALSE(isRefused(0, -3600));
  EXPECT_FALSE(isRefused(0, -4000));
}

TEST(Resonance, followsItsRuleFromBothSides) {
  for (double distance = 1e-6; distance < 20; distance *= 1.5)
    for (const double side : {-1, 1}) {
      expectTheRule(80.7836 + side * distance, 1);
      expectTheRule(0, -3803.54 + 20 * side * distance);
    }
}

TEST(Resonance, followsItsRuleOnAGrid) {
  int refused = 0;
  for (double a = -100; a <= 400; a += 20)
    for (double b = -6000; b <= 6000; b += 600) {
      expectTheRule(a, b);
      refused += isRefused(a, b);
    }
  EXPECT_GT(refused, 0);
}

// Parameters on both sides of the curve of resonances, which is found by its largest values.
TEST(Resonance, followsItsRuleAlongItsCurve) {
  for (double b = -3000; b <= 1500; b += 500) {
    double peak = 0, peakAt = 0;
    for (double a = 20; a < 110; ++a)
      if (const double value = largestByOracle(a, b, 8); value > peak) peak = value, peakAt = a;
    for (double a = peakAt - 1.5; a < peakAt + 1.5; a += 0.15) expectTheRule(a, b);
  }
}

TEST(Resonance, showsInTheReason) {
  const auto message = SweepBasis::make({2, 2 * 80.7836, 2}).error().message;
  EXPECT_NE(message.find("resonance"), std::string::npos) << message;
  EXPECT_NE(message.find("eta/rho <= 0 and lambda/rho >= 0"), std::string::npos) << message;
}

TEST(SafeRegime, alwaysAnswersWithASmallBasis) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> exponent(-12, 12);
  for (int i = 0; i < 3000; ++i) {
    const double a = -std::pow(10, exponent(random)), b = std::pow(10, 2 * exponent(random));
    for (const auto& [eta, lambda] : {std::pair{a, b}, {0.0, b}, {a, 0.0}, {a, a * a / 4}}) {
      const auto basis = SweepBasis::make({1, eta, lambda});
      ASSERT_TRUE(basis) << eta << ", " << lambda;
      for (double u = 0; u <= 1; u += 0.0625)
        for (const double g : basis->at(u))
          ASSERT_LE(std::abs(g), 1 + 1e-12) << eta << ", " << lambda;
    }
  }
}

TEST(Roots, thatOscillateFasterThanTheGridAreRefused) {
  EXPECT_TRUE(isRefused(1001.0 * 1001, 0));
  for (const auto& reason : {SweepBasis::make({1, 1e8, 0}).error().message,
                             SweepBasis::make({1, 0, -1e16}).error().message,
                             TangentBasis::make({0, 1, 1e8}).error().message}) {
    EXPECT_NE(reason.find("too fast"), std::string::npos) << reason;
    EXPECT_NE(reason.find("(roots near 10000, at most 1000)"), std::string::npos) << reason;
  }
  const auto message = SweepBasis::make({1, 1e20, 0}).error().message;
  EXPECT_NE(message.find("near more than 1000000000,"), std::string::npos) << message;
  const auto nearly = SweepBasis::make({1, 1.0005e6, 0}).error().message;
  EXPECT_NE(nearly.find("(roots near 1001, at most 1000)"), std::string::npos) << nearly;
  EXPECT_FALSE(isRefused(-1e8, 0));
}

TEST(Parameters, thatMakeNoEquationAreRefused) {
  EXPECT_EQ(SweepBasis::make({0, 1, 1}).error().message,
            "rho must not be zero: it leads the sixth-order equation.");
  EXPECT_EQ(TangentBasis::make({1, 0, 1}).error().message,
            "eta must not be zero: it leads the fourth-order equation.");
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    EXPECT_FALSE(SweepBasis::make({bad, 1, 1}));
    EXPECT_FALSE(SweepBasis::make({1, bad, 1}));
    EXPECT_FALSE(SweepBasis::make({1, 1, bad}));
    EXPECT_FALSE(SweepBasis::make({1, 0, 0}, bad));
    EXPECT_FALSE(TangentBasis::make({1, bad, 1}));
    EXPECT_FALSE(TangentBasis::make({1, 1, bad}));
  }
  EXPECT_FALSE(SweepBasis::make({1e-300, 1, 1e300}));
  EXPECT_FALSE(SweepBasis::make({1, -1e200, 1}));
  for (const double length : {0.0, -1.0}) EXPECT_FALSE(SweepBasis::make({}, length));
}

TEST(TangentResonance, isRefused) {
  const double pi = std::acos(-1.0);
  EXPECT_FALSE(TangentBasis::make({0, 1, 4 * pi * pi}));
  EXPECT_FALSE(TangentBasis::make({0, 1, 80.763}));
  EXPECT_FALSE(TangentBasis::make({0, 1, 80.763 / 9}, 3));
  const auto message = TangentBasis::make({0, 1, 81}).error().message;
  EXPECT_NE(message.find("lambda/eta <= 0"), std::string::npos) << message;
  EXPECT_NE(message.find("reaches 24, at most 10)"), std::string::npos) << message;
  EXPECT_TRUE(TangentBasis::make({0, 1, 30}));
  EXPECT_TRUE(TangentBasis::make({0, -1, 1e8}));
}

}  // namespace
}  // namespace sweepface
