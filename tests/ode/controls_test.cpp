#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

#include "sweepface/ode.hpp"

namespace sweepface {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

TEST(ControlCurves, lieOnTheParabolaOfTheDerivatives) {
  const auto [c2, c3] = controlsFromDerivatives({1, 2, 3}, {{4, 0, 0}, {0, 8, 0}}, {0.25, 0.5});
  EXPECT_EQ(c2, Vec3(2, 2.25, 3));
  EXPECT_EQ(c3, Vec3(3, 3, 3));
}

TEST(ControlCurves, giveTheirDerivativesBackWithUnequalSpacing) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int i = 0; i < 10000; ++i) {
    const double u2 = 0.05 + 0.1 * std::abs(unit(random));
    const ControlSpacing spacing{u2, u2 * (1.2 + 2 * std::abs(unit(random)))};
    const Vec3 boundary = point(), control2 = point(), control3 = point();
    const auto across = derivativesFromControls(boundary, control2, control3, spacing);
    ASSERT_TRUE(across);
    const auto [back2, back3] = controlsFromDerivatives(boundary, *across, spacing);
    // The scale of rounding errors: the size of the parabola's terms.
    const double terms = norm(boundary) + norm(across->first) * spacing.u3 +
                         norm(across->second) * spacing.u3 * spacing.u3;
    ASSERT_LE(norm(back2 - control2), 8 * epsilon * terms);
    ASSERT_LE(norm(back3 - control3), 8 * epsilon * terms);
  }
}

TEST(ControlCurves, besideTheFarBoundaryHaveNegativeParameters) {
  const CrossDerivatives across{{1, 2, 3}, {-4, 5, 6}};
  const ControlSpacing spacing{-0.125, -0.375};
  const auto [c2, c3] = controlsFromDerivatives({0, 0, 1}, across, spacing);
  const auto back = derivativesFromControls({0, 0, 1}, c2, c3, spacing);
  ASSERT_TRUE(back);
  EXPECT_LE(norm(back->first - across.first), 1e-14);
  EXPECT_LE(norm(back->second - across.second), 1e-13);
}

TEST(ControlCurves, areRefusedWhereTheySayNothing) {
  const Vec3 p{1, 1, 1};
  for (const ControlSpacing spacing :
       {ControlSpacing{0.1, 0.1}, {0, 0.1}, {0.1, 0}, {nan, 0.1}, {0.1, 1 / 0.0}})
    EXPECT_FALSE(derivativesFromControls(p, p, p, spacing));
  EXPECT_FALSE(derivativesFromControls({nan, 0, 0}, p, p, {0.1, 0.2}));
  EXPECT_FALSE(derivativesFromControls(p, {0, nan, 0}, p, {0.1, 0.2}));
  EXPECT_FALSE(derivativesFromControls(p, p, {0, 0, 1 / 0.0}, {0.1, 0.2}));
  EXPECT_FALSE(derivativesFromControls(p, {}, p, {1e-300, 2e-300}));
}

TEST(Spacing, isTheMeanChordAsAShareOfTheLength) {
  const std::vector<Vec3> boundary{{0, 0, 0}, {1, 0, 0}}, control2{{0, 1, 0}, {1, 3, 0}},
      control3{{0, 1, 5}, {1, 3, 7}};
  EXPECT_EQ(spacingFromChords(boundary, control2, control3, 16).value(),
            ControlSpacing(2.0 / 16, 8.0 / 16));
}

TEST(Spacing, isRefusedWithoutChords) {
  const std::vector<Vec3> a{{0, 0, 0}}, b{{0, 1, 0}}, c{{0, 2, 0}}, two(2), bad{{nan, 0, 0}};
  EXPECT_TRUE(spacingFromChords(a, b, c, 10));
  EXPECT_FALSE(spacingFromChords(a, a, c, 10));
  EXPECT_FALSE(spacingFromChords(a, b, b, 10));
  EXPECT_FALSE(spacingFromChords({}, {}, {}, 10));
  EXPECT_FALSE(spacingFromChords(a, two, c, 10));
  EXPECT_FALSE(spacingFromChords(a, b, two, 10));
  EXPECT_FALSE(spacingFromChords(a, b, bad, 10));
  for (const double length : {0.0, -1.0, nan, 1 / 0.0})
    EXPECT_FALSE(spacingFromChords(a, b, c, length));
}

}  // namespace
}  // namespace sweepface
