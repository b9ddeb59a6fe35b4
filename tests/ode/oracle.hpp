#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

namespace sweepface::test {

/// The basis of S'''''' + a S'''' + b S'' = 0 to many digits, computed differently from the
/// library: by one power series for all roots, about u = 0 instead of the middle, without case
/// distinctions. The end conditions lose up to 3 |r| / ln 10 digits; choose `Digits` beyond that.
template <unsigned Digits>
class Oracle {
 public:
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<Digits>,
                                               boost::multiprecision::et_off>;
  /// Derivatives of orders 0..5 of six functions: [order][function].
  using State = std::array<std::array<Number, 6>, 6>;

  Oracle(const Number& a, const Number& b) : a_(a), b_(b), end_(from0(1.0 / 16)) {
    for (int i = 0; i < 4; ++i) end_ = product(end_, end_);  // short series only
    solve();
  }

  /// g1..g6 and their derivatives.
  State at(double u) const {
    return u < 0.5 ? product(from0(u), start_) : product(product(from0(u - 1), end_), start_);
  }

 private:
  static double size(const Number& x) { return std::abs(x.template convert_to<double>()); }

  // At u = 0 the derivative of order j of function j is 1, and its others are 0. The functions are
  // combinations of G_m = sum h_k u^(2k+m)/(2k+m)!, each of which is the derivative of G_(m+1).
  State from0(double u) const {
    const double root = std::sqrt(1 + size(a_) + std::sqrt(size(b_)));  // a bound on |r|
    std::vector<Number> powers{1};                                      // u^n/n!
    double digits = 0;
    for (int n = 1; n < 12 || digits < Digits + 40; ++n) {
      powers.push_back(powers.back() * u / n);
      digits -= std::log10(root * std::abs(u) / n + 1e-300);
    }
    std::array<Number, 11> g{};  // G_-5 .. G_5
    Number h = 1, previous = 0;
    for (int k = 0; 2 * k - 5 < int(powers.size()); ++k) {
      for (int m = -5; m <= 5; ++m)
        if (const int n = 2 * k + m; n >= 0 && n < int(powers.size())) g[m + 5] += h * powers[n];
      previous = std::exchange(h, Number(-a_ * h - b_ * previous));
    }
    State s{};
    s[0][0] = s[1][1] = 1, s[0][1] = u;
    for (int order = 0; order < 6; ++order) {
      const Number* derivative = &g[5 - order];
      for (int j = 2; j < 6; ++j) s[order][j] = derivative[j];
      for (int j = 2; j < 4; ++j) s[order][j] += a_ * derivative[j + 2];
    }
    return s;
  }

  static State product(const State& a, const State& b) {
    State c{};
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 6 && a[i][k] != 0; ++j) c[i][j] += a[i][k] * b[k][j];
    return c;
  }

  // Finds the third to fifth derivatives at u = 0 from the conditions at u = 1.
  void solve() {
    std::array<std::array<Number, 9>, 3> m;  // unknowns, then right-hand sides of g1..g6
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        m[i][j] = end_[i][3 + j];
        m[i][3 + j] = -end_[i][j];
        m[i][6 + j] = i == j;
      }
    for (int k = 0; k < 3; ++k) {
      int pivot = k;
      for (int i = k; i < 3; ++i)
        if (abs(m[i][k]) > abs(m[pivot][k])) pivot = i;
      std::swap(m[k], m[pivot]);
      for (int i = 0; i < 3; ++i) {
        const Number factor = m[i][k] / m[k][k];
        for (int j = 0; j < 9 && i != k; ++j) m[i][j] -= factor * m[k][j];
      }
    }
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 3; ++i) {
        start_[i][j] = i == j;
        start_[3 + i][j] = m[i][3 + j] / m[i][i];
      }
  }

  Number a_, b_;
  State end_, start_{};
};

}  // namespace sweepface::test
