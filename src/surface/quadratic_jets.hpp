#pragma once

#include <array>
#include <complex>

#include "surface/chart.hpp"
#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"

namespace sweepface {

/// The vectors A, B, C, D, E of F(x, y) = p + A x + B y + ½ (C x² + 2 D x y + E y²).
using Quadratic = std::array<Index, 5>;

/// Writes rows of vectors that are derivatives of F over a chart.
class QuadraticJets {
 public:
  QuadraticJets(const JetNumbers& numbers, JetRows& rows) : numbers_(numbers), rows_(rows) {}

  /// Both derivatives along an arm, on which the chart has the derivatives `d`.
  void alongArm(Index node, std::size_t arm, const Quadratic& f,
                const std::array<std::complex<double>, 2>& d) {
    PlaneJet along{};
    along[jetComponent(1, 0)] = d[0];
    along[jetComponent(2, 0)] = d[1];
    for (int i = 1; i <= 2; ++i) compose(numbers_.alongArm(node, arm, i), f, along, i, 0);
  }

  /// The four mixed derivatives at a corner, where the chart has the jet `jet`.
  void atCorner(Index corner, const Quadratic& f, const PlaneJet& jet) {
    for (int i = 1; i <= 2; ++i)
      for (int j = 1; j <= 2; ++j) compose(numbers_.mixed(corner, i, j), f, jet, i, j);
  }

 private:
  // ∂α^i ∂β^j of F(φ(α, β)) by Leibniz' rule.
  void compose(Index vector, const Quadratic& f, const PlaneJet& jet, int i, int j) {
    constexpr double kBinomial[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 1}};
    double xx = 0, xy = 0, yy = 0;
    for (int a = 0; a <= i; ++a)
      for (int b = 0; b <= j; ++b) {
        const auto p = jet[jetComponent(a, b)], q = jet[jetComponent(i - a, j - b)];
        const double k = kBinomial[i][a] * kBinomial[j][b];
        xx += k * p.real() * q.real();
        xy += k * p.real() * q.imag();
        yy += k * p.imag() * q.imag();
      }
    const auto d = jet[jetComponent(i, j)];
    const double factors[5] = {d.real(), d.imag(), xx / 2, xy, yy / 2};
    rows_.open(vector);
    for (int k = 0; k < 5; ++k)  // mere rounding must not tie patches together
      if (std::abs(factors[k]) > 1e-14) rows_.add(f[k], factors[k]);
    rows_.close();
  }

  const JetNumbers& numbers_;
  JetRows& rows_;
};

}  // namespace sweepface
