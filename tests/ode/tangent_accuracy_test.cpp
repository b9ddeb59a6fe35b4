#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <utility>

#include "sweepface/ode.hpp"

#include "greater.hpp"

// Compares the fourth-order basis with its closed form in several hundred digits.
namespace sweepface {
namespace {

using Exactly = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<500>>;
using Functions = std::array<Exactly, 4>;

/// 1, u, c = cosh(r u) and w = sinh(r u) / r with r² = s, or their derivatives of an order: those
/// of c and w are s w and c.
Functions solutionsAt(double s, const Exactly& u, int order) {
  const Exactly r = sqrt(abs(Exactly(s))), x = r * u, e = exp(x);
  const Exactly c = s > 0 ? Exactly((e + 1 / e) / 2) : Exactly(cos(x));
  const Exactly w = s > 0 ? Exactly((e - 1 / e) / 2 / r) : Exactly(sin(x) / r);
  const Exactly power = pow(Exactly(s), order / 2), line = order == 0 ? u : Exactly(order == 1);
  if (order % 2 == 0) return {order == 0, line, power * c, power * w};
  return {0, line, power * s * w, power * c};
}

/// The solutions that have one end condition each: combinations of those above [end][solution].
std::array<Functions, 4> basisOf(double s) {
  std::array<std::array<Exactly, 8>, 4> m;  // conditions, then the four right-hand sides
  for (int end = 0; end < 2; ++end)
    for (int order = 0; order < 2; ++order) {
      const Functions at = solutionsAt(s, end, order);
      for (int j = 0; j < 4; ++j) {
        m[2 * end + order][j] = at[j];
        m[2 * end + order][4 + j] = 2 * end + order == j ? 1 : 0;
      }
    }
  for (int k = 0; k < 4; ++k) {
    const auto larger = [k](const auto& a, const auto& b) { return abs(a[k]) < abs(b[k]); };
    std::swap(m[k], *std::max_element(m.begin() + k, m.end(), larger));
    for (int i = 0; i < 4; ++i) {
      const Exactly factor = m[i][k] / m[k][k];
      for (int j = 0; j < 8 && i != k; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  std::array<Functions, 4> basis;
  for (int end = 0; end < 4; ++end)
    for (int j = 0; j < 4; ++j) basis[end][j] = m[j][4 + end] / m[j][j];
  return basis;
}

/// The largest error of values and derivatives, each relative to the largest of its order.
double errorOf(double s) {
  const auto basis = TangentBasis::make({0, 1, -s}).value();
  const auto exact = basisOf(s);
  double worst = 0;
  for (int order = 0; order < 4; ++order) {
    double error = 0, largest = 1;
    for (const double u : {0.0, 1e-9, 1e-3, 0.1, 0.3, 0.5, 0.77, 0.999, 1.0}) {
      const auto values = basis.at(u, order);
      const Functions at = solutionsAt(s, u, order);
      for (int end = 0; end < 4; ++end) {
        Exactly value = 0;
        for (int j = 0; j < 4; ++j) value += exact[end][j] * at[j];
        error = testing::greater(error, std::abs((value - values[end]).convert_to<double>()));
        largest = std::max(largest, std::abs(value.convert_to<double>()));
      }
    }
    worst = testing::greater(worst, error / largest);
  }
  return worst;
}

TEST(TangentAccuracy, isTwelveDigitsForRootsUpTo500) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(std::log(1e-6), std::log(500.0));
  for (int k = 0; k < 60; ++k) {
    const double s = std::exp(2 * exponent(random));
    EXPECT_LT(errorOf(s), 1e-12) << s;
  }
}

TEST(TangentAccuracy, isTwelveDigitsWhereItOscillates) {
  for (const double s : {1e-12, 1e-3, 0.5, 4.0, 15.9, 16.0, 16.1, 30.0, 55.0, 65.0})
    EXPECT_LT(errorOf(-s), 1e-12) << s;
}

TEST(TangentAccuracy, crossesTheBorderOfTheSeriesWithoutLoss) {
  for (const double s : {15.999999, 16.0, std::nextafter(16.0, 17.0), 16.000001})
    EXPECT_LT(errorOf(s), 1e-13) << s;
}

}  // namespace
}  // namespace sweepface
