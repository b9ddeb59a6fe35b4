#include "codec/kriging.hpp"

#include <array>
#include <cmath>

#include "codec/near_sites.hpp"
#include "codec/two.hpp"

namespace sweepface::codec {

namespace {

// A place on the neutral and the way it faces.
struct Stand {
  Vec3 position, facing;
};

std::vector<Stand> standsOf(const Surface& surface, const Hierarchy& hierarchy,
                            std::span<const Vec3> neutral) {
  std::vector<Vec3> vectors(surface.vectorCount());
  surface.settle(neutral, vectors);
  std::vector<Vec3> facing(surface.storedCount());  // by the vector of the position
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

constexpr std::size_t kMost = NearSites::kMost;
using Weights = std::array<double, kMost>;

// Numbers of the sites nearby, by twos.
class Row {
 public:
  double operator[](std::size_t k) const { return twos_[k / 2][k % 2]; }
  void set(std::size_t k, double x) { twos_[k / 2][k % 2] = x; }
  Two& two(std::size_t k) { return twos_[k]; }
  const Two& two(std::size_t k) const { return twos_[k]; }

  // this -= other * factor, for those from `first` on.
  void subtract(const Row& other, double factor, std::size_t first, std::size_t end) {
    for (std::size_t k = first / 2; k < (end + 1) / 2; ++k) twos_[k] -= other.twos_[k] * factor;
  }

 private:
  std::array<Two, kMost / 2> twos_{};
};

Two rootOf(const Two& x) { return Two{std::sqrt(x[0]), std::sqrt(x[1])}; }

// Where the sites nearby stand.
class Stands {
 public:
  Stands(std::span<const Stand> stands, std::span<const Index> near, double turned)
      : turnedSquared_(turned * turned) {
    for (std::size_t k = 0; k < near.size(); ++k) {
      const auto& [p, f] = stands[near[k]];
      const std::array<double, 6> numbers{p.x, p.y, p.z, f.x, f.y, f.z};
      for (std::size_t c = 0; c < numbers.size(); ++c) rows_[c].set(k, numbers[c]);
    }
  }

  // The power 1.5 of the distances of two of them from another place.
  Two apart(std::size_t two, const Stand& from) const {
    const auto squares = [&](std::size_t c, const Vec3& v) {
      const Two x = v.x - rows_[c].two(two), y = v.y - rows_[c + 1].two(two),
                z = v.z - rows_[c + 2].two(two);
      return x * x + y * y + z * z;
    };
    const Two r = rootOf(squares(0, from.position) + turnedSquared_ * squares(3, from.facing));
    return r * rootOf(r);
  }

 private:
  double turnedSquared_;
  std::array<Row, 6> rows_;
};

// Weights that sum to 1, by Cholesky's factors of what the differences from the place itself have
// in common. False where they cannot be told.
bool weigh(const Stand& own, std::span<const Stand> stands, std::span<const Index> near,
           double turned, Weights& weights) {
  const std::size_t n = near.size(), twos = (n + 1) / 2;
  if (n == 0 || n > kMost) return false;
  const Stands around(stands, near, turned);
  Row away;
  for (std::size_t two = 0; two < twos; ++two) away.two(two) = around.apart(two, own);
  double mean = 0;
  for (std::size_t k = 0; k < n; ++k) mean += away[k];
  mean /= static_cast<double>(n);
  if (!(mean > 0) || !std::isfinite(mean)) return false;
  constexpr double kRidge = 1e-6;
  std::array<Row, kMost> columns;  // from the diagonal down
  Row sums;
  for (std::size_t two = 0; two < twos; ++two) sums.two(two) = Two{1, 1};
  for (std::size_t j = 0; j < n; ++j) {
    Row& column = columns[j];
    for (std::size_t two = j / 2; two < twos; ++two)
      column.two(two) = away[j] + away.two(two) - around.apart(two, stands[near[j]]);
    column.set(j, 2 * away[j] + kRidge * mean);
  }
  for (std::size_t j = 0; j < n; ++j) {
    Row& column = columns[j];
    if (!(column[j] > 0)) return false;
    const double root = std::sqrt(column[j]);
    for (std::size_t two = j / 2; two < twos; ++two) column.two(two) /= root;
    column.set(j, root);
    for (std::size_t k = j + 1; k < n; ++k) columns[k].subtract(column, column[k], k, n);
    weights[j] = sums[j] / root;
    sums.subtract(column, weights[j], j + 1, n);
  }
  double total = 0;
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) weights[i] -= columns[i][k] * weights[k];
    total += weights[i] /= columns[i][i];
  }
  // Rounded so that no last digit counts; the nearest makes up for it.
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
  const Prediction& lines = hierarchy.prediction();
  Prediction moves;
  moves.steps.reserve(lines.steps.size());
  moves.terms.reserve(2 * lines.terms.size());
  Weights weights;
  for (Prediction::Step step : lines.steps) {
    const auto before = lines.of(step);
    const auto near = hierarchy.near(step.site);
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
