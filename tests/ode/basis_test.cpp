#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "sweepface/ode.hpp"

namespace sweepface {
namespace {

struct Named {
  const char* name;
  double a, b;
  friend void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }
};

const Named equations[] = {
    {"polynomial", 0, 0},    {"real", -90, 729},        {"repeated", -50, 625},
    {"complex", 7, 900},     {"imaginary", 50, 300},    {"mixed", -30, -500},
    {"zeroBeside", -100, 0}, {"tinyBeside", 30, 1e-20}, {"nearlyZero", 1e-9, -1e-12},
    {"small", 3, -4},
};

class Basis : public ::testing::TestWithParam<Named> {
 protected:
  double a() const { return GetParam().a; }
  double b() const { return GetParam().b; }
  SweepBasis basis() const { return SweepBasis::make({1, a(), b()}).value(); }
};

TEST_P(Basis, meetsEachEndConditionExactly) {
  for (int end = 0; end < 2; ++end)
    for (int order = 0; order < 3; ++order) {
      std::array<double, 6> expected{};
      expected[3 * end + order] = 1;
      EXPECT_EQ(basis().at(end, order), expected);
    }
}

TEST_P(Basis, approachesItsEndsWithoutAStep) {
  for (int order = 0; order < 3; ++order)
    for (const double u : {0.0, 1.0}) {
      const auto end = basis().at(u, order), beside = basis().at(std::abs(u - 1e-17), order);
      const auto inside = basis().at(std::nextafter(u, 0.5), order);
      for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(beside[i], end[i], 1e-11);
        EXPECT_NEAR(inside[i], end[i], 1e-11);
      }
    }
}

TEST_P(Basis, isMirroredBetweenTheEnds) {
  for (int order = 0; order < 4; ++order)
    for (const double u : {0.125, 0.25, 0.375, 0.5, 0.875}) {
      const auto g = basis().at(u, order), mirrored = basis().at(1 - u, order);
      for (int c = 0; c < 3; ++c)
        EXPECT_DOUBLE_EQ(g[c], ((c + order) % 2 ? -1 : 1) * mirrored[3 + c]);
    }
}

TEST_P(Basis, hasTheDerivativesOfItsValues) {
  const double h = 1.0 / 1024;
  for (int order = 1; order < 4; ++order)
    for (double u = 0.0625; u < 1; u += 0.0625) {
      const auto g = basis().at(u, order);
      const auto at = [&](int steps) { return basis().at(u + steps * h, order - 1); };
      for (int i = 0; i < 6; ++i) {
        const double slope =
            (45 * (at(1)[i] - at(-1)[i]) - 9 * (at(2)[i] - at(-2)[i]) + (at(3)[i] - at(-3)[i])) /
            (60 * h);
        EXPECT_NEAR(g[i], slope, 1e-9 * (1 + std::abs(g[i]))) << u << " order " << order;
      }
    }
}

// The equation integrated three times: S''' + a S' + b (the integral of S) is a parabola, whose
// third differences vanish.
TEST_P(Basis, solvesTheEquation) {
  const double step = 1.0 / 16;
  const std::array nodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                         0.9061798459386640};
  const std::array weights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                           0.4786286704993665, 0.2369268850561891};
  for (int i = 0; i < 6; ++i) {
    std::vector<double> terms;
    double integral = 0;
    for (int k = 0; k <= 16; ++k) {
      const double u = k * step;
      terms.push_back(basis().at(u, 3)[i] + a() * basis().at(u, 1)[i] + b() * integral);
      for (int n = 0; n < 5; ++n)
        integral += step / 2 * weights[n] * basis().at(u + step / 2 * (1 + nodes[n]))[i];
    }
    double largest = 1;
    for (const double term : terms) largest = std::max(largest, std::abs(term));
    for (std::size_t k = 3; k < terms.size(); ++k)
      EXPECT_NEAR(terms[k] - 3 * terms[k - 1] + 3 * terms[k - 2], terms[k - 3], 1e-12 * largest);
  }
}

// Constants and straight lines solve each of the equations.
TEST_P(Basis, keepsStraightLines) {
  for (double u = 0; u <= 1; u += 0.03125) {
    const auto g = basis().at(u);
    EXPECT_NEAR(g[0] + g[3], 1, 1e-13);
    EXPECT_NEAR(g[1] + g[3] + g[4], u, 1e-13);
  }
}

TEST_P(Basis, dependsOnQuotientsAndLengthAlone) {
  const auto same = SweepBasis::make({-2, -2 * a() / 16, -2 * b() / 256}, 4).value();
  for (double u = 0; u <= 1; u += 0.125) EXPECT_EQ(same.at(u), basis().at(u));
}

TEST_P(Basis, staysAtItsEndsBeyondThem) {
  for (int order = 0; order < 4; ++order) {
    EXPECT_EQ(basis().at(-0.5, order), basis().at(0, order));
    EXPECT_EQ(basis().at(1.5, order), basis().at(1, order));
  }
}

INSTANTIATE_TEST_SUITE_P(Equations, Basis, ::testing::ValuesIn(equations),
                         [](const auto& test) { return std::string(test.param.name); });

// Where the roots change their kind, or the library switches to another form of the solutions.
TEST(Borders, areCrossedWithoutAStep) {
  const auto squares = [](double s1, double s2) { return std::pair{-(s1 + s2), s1 * s2}; };
  const double close = std::sqrt(1.5);
  const std::pair<double, double> borders[] = {
      {0, 0},
      {-10, 0},
      {30, 0},
      {-300, 0},
      {0, 256},
      {-20, 256},
      {20, 256},
      squares(16, 1),
      squares(-16, 1),
      squares(-16, -5),
      squares(16, 16),
      squares(-16, -16),
      squares(90, 90),
      squares(-50, -50),
      squares(std::pow(9 + close, 2), std::pow(9 - close, 2)),
      squares(-std::pow(9 + close, 2), -std::pow(9 - close, 2))};
  for (const auto& [a, b] : borders) {
    const double da = 1e-15 * (1 + std::abs(a)), db = 1e-15 * (1 + std::abs(b));
    const auto one = SweepBasis::make({1, a - da, b - db}).value();
    const auto other = SweepBasis::make({1, a + da, b + db}).value();
    for (int order = 0; order < 4; ++order) {
      std::array<double, 6> largest{}, step{};
      for (double u = 0; u <= 1; u += 0.03125)
        for (int i = 0; i < 6; ++i) {
          const double g = one.at(u, order)[i], h = other.at(u, order)[i];
          largest[i] = std::max(largest[i], std::abs(g));
          step[i] = std::max(step[i], std::abs(g - h));
        }
      for (int i = 0; i < 6; ++i) EXPECT_LE(step[i], 1e-12 * largest[i]) << a << ", " << b;
    }
  }
}

TEST(SweepBasisDefault, isTheQuinticHermitePolynomials) {
  for (double u = 0; u <= 1; u += 0.0625) {
    const auto g = SweepBasis().at(u);
    const double u3 = u * u * u, u4 = u3 * u, u5 = u4 * u;
    const std::array expected{1 - 10 * u3 + 15 * u4 - 6 * u5,     u - 6 * u3 + 8 * u4 - 3 * u5,
                              (u * u - 3 * u3 + 3 * u4 - u5) / 2, 10 * u3 - 15 * u4 + 6 * u5,
                              -4 * u3 + 7 * u4 - 3 * u5,          (u3 - 2 * u4 + u5) / 2};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(g[i], expected[i], 4e-16);
  }
}

TEST(TangentBasisDefault, isTheCubicHermitePolynomials) {
  for (double u = 0; u <= 1; u += 0.0625) {
    const auto g = TangentBasis().at(u);
    const std::array expected{(1 + 2 * u) * (1 - u) * (1 - u), u * (1 - u) * (1 - u),
                              u * u * (3 - 2 * u), u * u * (u - 1)};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(g[i], expected[i], 4e-16);
  }
}

TEST(TangentBasis, solvesTheFourthOrderEquation) {
  for (const double s : {-300.0, -30.0, -16.0, -3.0, 0.0, 1e-9, 16.0, 17.0, 900.0, 1e6}) {
    const auto basis = TangentBasis::make({0, 1, -s}).value();
    for (int end = 0; end < 2; ++end)
      for (int order = 0; order < 2; ++order) {
        std::array<double, 4> expected{};
        expected[2 * end + order] = 1;
        EXPECT_EQ(basis.at(end, order), expected);
      }
    // Integrated once: S''' - s S' is constant.
    for (int i = 0; i < 4; ++i) {
      const auto constant = [&](double u) { return basis.at(u, 3)[i] - s * basis.at(u, 1)[i]; };
      const double size = std::abs(basis.at(0, 3)[i]) + std::abs(s) + 1;
      for (double u = 0; u <= 1; u += 0.125) EXPECT_NEAR(constant(u), constant(0), 1e-13 * size);
    }
    for (double u = 0.125; u < 1; u += 0.125)
      for (int order = 1; order < 4; ++order)
        for (int i = 0; i < 4; ++i) {
          const double h = 1e-4,
                       slope = (basis.at(u + h, order - 1)[i] - basis.at(u - h, order - 1)[i]) /
                               (2 * h);
          EXPECT_NEAR(basis.at(u, order)[i], slope, 1e-4 * (1 + std::abs(s * slope)));
        }
  }
}

TEST(TangentBasis, dependsOnTheQuotientAndLengthAloneAndStaysAtItsEndsBeyondThem) {
  for (const double s : {-30.0, 3.0, 900.0}) {
    const auto basis = TangentBasis::make({0, 1, -s}).value();
    const auto same = TangentBasis::make({5, -2, 2 * s / 16}, 4).value();
    for (int order = 0; order < 4; ++order) {
      for (double u = 0; u <= 1; u += 0.125) EXPECT_EQ(same.at(u, order), basis.at(u, order));
      EXPECT_EQ(basis.at(-0.5, order), basis.at(0, order));
      EXPECT_EQ(basis.at(1.5, order), basis.at(1, order));
    }
  }
}

TEST(LinearBasis, joinsTheEndsByALine) {
  const LinearBasis basis;
  EXPECT_EQ(basis.at(-0.5), (std::array{1.0, 0.0}));
  EXPECT_EQ(basis.at(1.5), (std::array{0.0, 1.0}));
  EXPECT_EQ(basis.at(0.25), (std::array{0.75, 0.25}));
  EXPECT_EQ(basis.at(0.25, 1), (std::array{-1.0, 1.0}));
  EXPECT_EQ(basis.at(0.25, 2), (std::array{0.0, 0.0}));
}

// As rho tends to 0, the second derivatives at the ends only affect thin boundary layers, and the
// solutions of the sixth-order equation approach those of the fourth-order one.
TEST(Orders, comeToEachOtherAsTheLeadingParameterVanishes) {
  const Shape shape{-1e-10, 1, -20};
  const auto six = SweepBasis::make(shape).value();
  const auto four = TangentBasis::make(shape).value();
  for (double u = 0; u <= 1; u += 0.0625) {
    const auto g = six.at(u);
    const auto f = four.at(u);
    for (int end = 0; end < 2; ++end)
      for (int c = 0; c < 2; ++c) EXPECT_NEAR(g[3 * end + c], f[2 * end + c], 1e-4);
  }
}

}  // namespace
}  // namespace sweepface
