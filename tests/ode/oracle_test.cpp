#include "ode/oracle.hpp"

#include <gtest/gtest.h>

// Tests the oracle itself against known results.
namespace sweepface::test {
namespace {

using Wide = Oracle<200>;

template <typename Number>
double distance(const Number& x, const Number& y) {
  return std::abs(Number(x - y).template convert_to<double>());
}

TEST(Oracle, meetsTheEndConditions) {
  const Wide oracle(-1000, 90000);
  for (int end = 0; end < 2; ++end) {
    const auto s = oracle.at(end);
    for (int order = 0; order < 3; ++order)
      for (int i = 0; i < 6; ++i)
        EXPECT_LT(distance<Wide::Number>(s[order][i], i == 3 * end + order), 1e-80);
  }
}

// For roots +-p and +-q, z = S'''' - p^2 S'' solves z'' = q^2 z, so (z' - q z) e^(q u) is constant.
TEST(Oracle, solvesTheEquation) {
  const int p = 3, q = 5;
  const Wide oracle(-(p * p + q * q), p * p * q * q);
  const auto constant = [&](double u, int i) {
    const auto s = oracle.at(u);
    const Wide::Number z = s[4][i] - p * p * s[2][i], slope = s[5][i] - p * p * s[3][i];
    return Wide::Number((slope - q * z) * exp(Wide::Number(q * u)));
  };
  for (int i = 0; i < 6; ++i)
    for (const double u : {0.125, 0.5, 0.75, 1.0})
      EXPECT_LT(distance(constant(u, i), constant(0, i)), 1e-100);
}

TEST(Oracle, isTheQuinticHermitePolynomialWithoutParameters) {
  const Wide oracle(0, 0);
  const Wide::Number u = 0.3;
  EXPECT_LT(distance<Wide::Number>(oracle.at(0.3)[0][3], u * u * u * (10 - 15 * u + 6 * u * u)),
            1e-150);
}

// The precision used by the accuracy tests suffices: many more digits give the same result.
template <unsigned Digits, unsigned More>
void expectSame(double a, double b) {
  const Oracle<Digits> oracle(a, b);
  const Oracle<More> wider(a, b);
  for (const double u : {0.001, 0.25, 0.9375, 0.998}) {
    const auto s = oracle.at(u);
    const auto t = wider.at(u);
    for (int order = 0; order < 4; ++order)
      for (int i = 0; i < 6; ++i) {
        using Number = typename Oracle<More>::Number;
        const double size = std::abs(t[order][i].template convert_to<double>());
        EXPECT_LE(distance(Number(s[order][i]), t[order][i]), 1e-40 * size + 1e-50);
      }
  }
}

TEST(Oracle, hasDigitsEnough) {
  expectSame<72, 150>(-50, 625);
  expectSame<72, 150>(50, 600);
  expectSame<96, 200>(-800, 160000);
  expectSame<200, 400>(-20000, 1e8);
  expectSame<720, 1000>(-500000, 62.5e9);
  expectSame<720, 1000>(-250000, 1);
}

}  // namespace
}  // namespace sweepface::test
