#include "surface/chart.hpp"

#include <cmath>

#include "ode/elementary.hpp"
#include "ode/power.hpp"

namespace sweepface {

namespace {

using Complex = std::complex<double>;

// The points at (0..2, 0..2) of the characteristic map, with the first spoke along +1.
struct RingPoints {
  Complex at[3][3];
};

// The subdominant eigenvector of Catmull–Clark subdivision with rotation by `angle` from sector to
// sector: each new point of the second ring is λ times the old one that it replaces.
RingPoints characteristicRings(double angle) {
  const double c = ode::sineCosine(angle).cosine;
  const double lambda = (c + 5 + std::sqrt((c + 9) * (c + 1))) / 16;
  if (!(lambda > 0.25)) return {};  // two patches alone: no map, and nothing moves
  const Complex w = onCircle(angle), back = std::conj(w);
  const Complex face = (1.0 + w) / (4 * lambda - 1);

  // The second ring: e = (2,0) by the vertex rule, f = (2,1) and g = (1,2) by the edge rule.
  // By symmetry about the sector's diagonal, g = w·conj(f).
  const double edge = lambda - 1.0 / 16;
  const Complex f0 = (3.0 / 8 * (1.0 + face) + w / 16.0) / edge;  // f = f0 + e / (16 edge)
  const Complex g0 = (3.0 / 8 * (w + face) + 1.0 / 16) / edge;    // g = g0 + w e / (16 edge)
  // (λ − 3/32) e = 9/16 + 3/32 (face + back face) + 1/64 (w + back + f + back g)
  const double k = 1 / (16 * edge);
  const Complex known =
      9.0 / 16 + 3.0 / 32 * (face + back * face) + (w + back + f0 + back * g0) / 64.0;
  const Complex e = known / (lambda - 3.0 / 32 - (k + k) / 64.0);
  const Complex f = f0 + k * e, g = g0 + k * w * e;
  const Complex corner =
      (9.0 / 16 * face + 3.0 / 32 * (1.0 + w + f + g) + (e + w * e) / 64.0) / (lambda - 1.0 / 64);
  return {{{0, w, w * e}, {1, face, g}, {e, f, corner}}};
}

// Derivatives 0, 1, 2 at 0 of the parabola through values at 0, 1, 2.
constexpr double kParabola[3][3] = {{1, 0, 0}, {-1.5, 2, -0.5}, {1, -2, 1}};

}  // namespace

std::complex<double> onCircle(double angle) {
  const auto [sine, cosine] = ode::sineCosine(angle);
  return {cosine, sine};
}

PlaneJet characteristicCorner(double start, double angle, double scale) {
  const RingPoints ring = characteristicRings(angle);
  const Complex turn = onCircle(start);
  PlaneJet jet{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Complex sum = 0;
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sum += kParabola[i][a] * kParabola[j][b] * ring.at[a][b];
      jet[3 * i + j] = sum * turn * ode::power(scale, 1 - i - j);
    }
  return jet;
}

std::array<Complex, 2> characteristicSpoke(double direction, double angle, double scale) {
  const double reach = characteristicRings(angle).at[2][0].real();
  const Complex unit = onCircle(direction);
  return {unit * (2 - reach / 2), unit * ((reach - 2) / scale)};
}

PlaneJet collapsedCorner(double ray, double turn, bool collapsedFirst) {
  const Complex unit = onCircle(ray), rate{0, turn};
  PlaneJet jet{};
  const int step = collapsedFirst ? 3 : 1, out = collapsedFirst ? 1 : 3;
  jet[out] = unit;
  jet[out + step] = rate * unit;
  jet[out + 2 * step] = rate * rate * unit;
  return jet;
}

}  // namespace sweepface
