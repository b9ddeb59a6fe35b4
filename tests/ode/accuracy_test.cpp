#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <random>

#include "sweepface/ode.hpp"

#include "greater.hpp"
#include "ode/oracle.hpp"

// Compares the basis with an oracle of at least 50 digits, over random roots of every kind.
namespace sweepface {
namespace {

struct Equation {
  double a, b;  // S'''''' + a S'''' + b S'' = 0
};

/// Random roots of magnitude between `least` and `most`.
struct Roots {
  std::mt19937_64 random;
  double least, most;

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  double between(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  double any() { return between(least, most); }
  double sign() { return uniform(-1, 1) < 0 ? -1 : 1; }
  double almostOne() { return 1 + sign() * between(1e-16, 0.1); }
  bool coin() { return sign() < 0; }
};

// The equation whose roots have these squares.
Equation squares(double s1, double s2) { return {-(s1 + s2), s1 * s2}; }
double sq(double x) { return x * x; }

struct Kind {
  const char* name;
  std::function<Equation(Roots&)> draw;
  friend void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
};

const Kind kinds[] = {
    {"real", [](Roots& r) { return squares(sq(r.any()), sq(r.any())); }},
    {"imaginary", [](Roots& r) { return squares(-sq(r.any()), -sq(r.any())); }},
    {"realAndImaginary", [](Roots& r) { return squares(sq(r.any()), -sq(r.any())); }},
    {"complex",
     [](Roots& r) {
       const double modulus = sq(r.any());
       return Equation{r.uniform(-2, 2) * modulus, sq(modulus)};
     }},
    {"repeated",
     [](Roots& r) {
       const double s = r.sign() * sq(r.any());
       return squares(s, s);
     }},
    {"nearlyRepeated",
     [](Roots& r) {
       const double s = r.sign() * sq(r.any());
       return r.coin() ? squares(s, s * r.almostOne()) : Equation{-2 * s, s * s * r.almostOne()};
     }},
    {"zero",
     [](Roots& r) {
       const double s = r.sign() * sq(r.any());
       return r.coin() ? squares(s, 0) : Equation{0, r.sign() * sq(s)};
     }},
    {"nearlyZero",
     [](Roots& r) {
       const double tiny = r.coin() ? 1e-300 : 1e-8;
       return squares(r.sign() * sq(r.any()), r.sign() * r.between(tiny, 1));
     }},
    {"bothNearlyZero",
     [](Roots& r) {
       return Equation{r.sign() * r.between(1e-300, 1), r.sign() * r.between(1e-300, 1)};
     }},
    // Where the library switches from one form of the solutions to another.
    {"border",
     [](Roots& r) {
       const double beside = 1 + r.uniform(-4, 4) * 1e-16, s = r.sign() * sq(r.any());
       switch (r.random() % 5) {
         case 0:
           return squares(r.sign() * 16 * beside, std::clamp(s, -16.0, 16.0));
         case 1:
           return Equation{r.uniform(-32, 32), 256 * beside};
         case 2:
           return Equation{-2 * s, s * s * beside};
         case 3:
           return Equation{-s, r.sign() * r.between(1e-300, 1e-10)};
         default: {  // p^2 or q^2 of 1.5, for r = p +- q
           const double root = std::sqrt(std::abs(s) + 1.5), other = std::sqrt(1.5) * beside;
           return squares(r.sign() * sq(root + other), r.sign() * sq(root - other));
         }
       }
     }},
};

struct Largest {
  double value[4][6] = {}, error[4][6] = {};
};

template <unsigned Digits>
Largest compare(const SweepBasis& basis, const Equation& e) {
  const test::Oracle<Digits> oracle(e.a, e.b);
  std::vector<double> places;
  for (int i = 0; i <= 8; ++i) places.push_back(i / 8.0);
  // Boundary layers have a width of about 1/|r|.
  const double root = std::sqrt(1 + std::abs(e.a) + std::sqrt(std::abs(e.b)));
  for (const double width : {0.2, 0.7, 1.5, 4.0})
    for (const double u : {width / root, 1 - width / root})
      if (u > 0 && u < 1) places.push_back(u);
  Largest largest;
  for (const double u : places) {
    const auto expected = oracle.at(u);
    for (int order = 0; order < 4; ++order) {
      const auto g = basis.at(u, order);
      for (int i = 0; i < 6; ++i) {
        const auto keep = [](double& x, const auto& y) {
          x = testing::greater(x, std::abs(y.template convert_to<double>()));
        };
        keep(largest.value[order][i], expected[order][i]);
        keep(largest.error[order][i],
             typename test::Oracle<Digits>::Number(expected[order][i] - g[i]));
      }
    }
  }
  return largest;
}

// Relative to the largest modulus of each function and derivative.
template <unsigned Digits>
double worstError(const SweepBasis& basis, const Equation& e) {
  const Largest largest = compare<Digits>(basis, e);
  double worst = 0;
  for (int order = 0; order < 4; ++order)
    for (int i = 0; i < 6; ++i)
      worst = testing::greater(worst, largest.error[order][i] / largest.value[order][i]);
  return worst;
}

struct Range {
  const char* name;
  double least, most, tolerance;
  double (*worst)(const SweepBasis&, const Equation&);
};

const Range slow{"upTo5", 1e-8, 5, 1e-12, worstError<72>};
const Range plain{"upTo20", 1, 20, 1e-12, worstError<96>};
const Range fast{"upTo100", 20, 100, 1e-12, worstError<200>};
const Range stiff{"upTo500", 100, 500, 1e-9, worstError<720>};

void check(const Kind& kind, const Range& range, int count) {
  Roots roots{std::mt19937_64(7), range.least, range.most};
  double worst = 0;
  int refused = 0;
  for (int i = 0; i < count;) {
    const Equation e = kind.draw(roots);
    const auto basis = SweepBasis::make({1, e.a, e.b});
    if (!basis) {
      ASSERT_LT(++refused, 100 + count) << "hardly any parameters are accepted";
      ASSERT_TRUE(e.a > 0 || e.b < 0) << "refused in the safe regime: " << e.a << ", " << e.b;
      continue;
    }
    ++i;
    const double error = range.worst(*basis, e);
    ASSERT_LE(error, range.tolerance) << "a = " << e.a << ", b = " << e.b;
    worst = std::max(worst, error);
  }
  std::cout << kind.name << " " << range.name << ": " << count << " sets, " << refused
            << " refused, worst error " << worst << "\n";
}

class Accuracy : public ::testing::TestWithParam<Kind> {};

TEST_P(Accuracy, isTwelveDigitsForRootsUpTo5) { check(GetParam(), slow, 600); }
TEST_P(Accuracy, isTwelveDigitsForRootsUpTo20) { check(GetParam(), plain, 400); }
TEST_P(Accuracy, isTwelveDigitsForRootsUpTo100) { check(GetParam(), fast, 20); }
TEST_P(Accuracy, isNineDigitsForRootsUpTo500) { check(GetParam(), stiff, 2); }

class AccuracyLong : public ::testing::TestWithParam<Kind> {};

TEST_P(AccuracyLong, isTwelveDigitsForRootsUpTo5) { check(GetParam(), slow, 4000); }
TEST_P(AccuracyLong, isTwelveDigitsForRootsUpTo20) { check(GetParam(), plain, 4000); }
TEST_P(AccuracyLong, isTwelveDigitsForRootsUpTo100) { check(GetParam(), fast, 400); }
TEST_P(AccuracyLong, isNineDigitsForRootsUpTo500) { check(GetParam(), stiff, 50); }

const auto nameOf = [](const auto& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(Roots, Accuracy, ::testing::ValuesIn(kinds), nameOf);
INSTANTIATE_TEST_SUITE_P(Roots, AccuracyLong, ::testing::ValuesIn(kinds), nameOf);

}  // namespace
}  // namespace sweepface
