#include "codec/kriging.hpp"

#include <array>
#include <cmath>

#include "codec/near_sites.hpp"

namespace sweepface::codec {

namespace {

// A position on the neutral and the normal there.
struct Stand {
  Vec3 position, facing;
};

std::vector<Stand> standsOf(const Surface& surface, const Hierarchy& hierarchy,
                            std::span<const Vec3> neutral) {
  std::vector<Vec3> vectors(surface.vectorCount());
  surface.settle(neutral, vectors);
  std::vector<Vec3> facing(surface.storedCount());  // by position vector
  const auto jet = [&](Index patch, int corner, int i, int j) {
    const JetRef ref = surface.cornerJet(patch, corner, i, j);
    return ref.sign * vectors[ref.vector];
  };
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int corner = 0; corner < 4; ++corner) {
      const Index position = surface.cornerJet(p, corner, 0, 0).vector;
      if (position < surface.storedCount())
        facing[position] += cross(jet(p, corner, 1, 0), jet(p, corner, 0, 1));
    }
  std::vector<Stand> stands;
  for (const CodedSite& site : hierarchy.sites()) {
    const Vec3 n = facing[site.first];
    const double length = norm(n);
    stands.push_back({neutral[site.first], length > 0 ? n * (1 / length) : Vec3{}});
  }
  return stands;
}

// The variogram: the distance to the power 1.5.
double apart(const Stand& a, const Stand& b, double turned) {
  const Vec3 way = a.position - b.position, turn = a.facing - b.facing;
  const double r = std::sqrt(dot(way, way) + turned * turned * dot(turn, turn));
  return r * std::sqrt(r);
}

constexpr std::size_t kMost = NearSites::kMost;
using Weights = std::array<double, kMost>;

// Subtracts a multiple of a known row. It works on adjacent numbers, so that compilers can
// vectorise it.
void subtract(Weights& from, const Weights& row, double factor, std::size_t first,
              std::size_t end) {
  for (std::size_t k = first; k < end; ++k) from[k] -= row[k] * factor;
}

// Computes weights that sum to 1, by Cholesky factorisation of the covariances of the differences
// from the place itself. False if there are none.
bool weigh(const Stand& own, std::span<const Stand> stands, std::span<const Index> near,
           double turned, Weights& weights) {
  const std::size_t n = near.size();
  if (n == 0 || n > kMost) return false;
  Weights away;
  double mean = 0;
  for (std::size_t k = 0; k < n; ++k) mean += away[k] = apart(own, stands[near[k]], turned);
  mean /= static_cast<double>(n);
  if (!(mean > 0) || !std::isfinite(mean)) return false;
  constexpr double kRidge = 1e-6;
  std::array<Weights, kMost> columns;  // from the diagonal down
  for (std::size_t j = 0; j < n; ++j) {
    weights[j] = 1;
    columns[j][j] = 2 * away[j] + kRidge * mean;
    for (std::size_t i = j + 1; i < n; ++i)
      columns[j][i] = away[i] + away[j] - apart(stands[near[i]], stands[near[j]], turned);
  }
  for (std::size_t j = 0; j < n; ++j) {
    Weights& column = columns[j];
    if (!(column[j] > 0)) return false;
    const double root = column[j] = std::sqrt(column[j]);
    for (std::size_t i = j + 1; i < n; ++i) column[i] /= root;
    for (std::size_t k = j + 1; k < n; ++k) subtract(columns[k], column, column[k], k, n);
    weights[j] /= root;
    subtract(weights, column, weights[j], j + 1, n);
  }
  double total = 0;
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) weights[i] -= columns[i][k] * weights[k];
    total += weights[i] /= columns[i][i];
  }
  // Round the weights so that last digits do not matter; the nearest site takes up the remainder.
  constexpr double kUnit = 65536, kLargest = 4;
  double others = 0;
  for (std::size_t i = n; i-- > 0;) {
    weights[i] = std::round(weights[i] / total * kUnit) / kUnit;
    if (!(std::abs(weights[i]) <= kLargest)) return false;
    if (i > 0) others += weights[i];
  }
  weights[0] = 1 - others;
  return true;
}

}  // namespace

Prediction predictMoves(const Surface& surface, const Hierarchy& hierarchy,
                        std::span<const Vec3> neutral, double turned) {
  const std::vector<Stand> stands = standsOf(surface, hierarchy, neutral);
  const NearTable nearSites(surface, hierarchy);
  const Prediction& lines = hierarchy.prediction();
  Prediction moves;
  moves.steps.reserve(lines.steps.size());
  moves.terms.reserve(2 * lines.terms.size());
  Weights weights;
  for (Prediction::Step step : lines.steps) {
    const auto before = lines.of(step);
    const auto near = nearSites.of(step.site);
    const bool isPosition = step.vector == hierarchy.sites()[step.site].first;
    step.terms = static_cast<Index>(moves.terms.size());
    if (isPosition && weigh(stands[step.site], stands, near, turned, weights))
      for (std::size_t k = 0; k < near.size(); ++k)
        moves.terms.push_back({hierarchy.sites()[near[k]].first, weights[k]});
    else
      moves.terms.insert(moves.terms.end(), before.begin(), before.end());
    step.termsEnd = static_cast<Index>(moves.terms.size());
    moves.steps.push_back(step);
  }
  return moves;
}

}  // namespace sweepface::codec
