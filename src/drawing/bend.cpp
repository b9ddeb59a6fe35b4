// What is not drawn bends least. Bending is the sum over the patches of the integral of |S_uu|^2 +
// 2 |S_uv|^2 + |S_vv|^2, where u and v run from 0 to the square roots of the drawn length and width
// of the patch. This is the centripetal spacing of E. T. Y. Lee (1989) for the knots of splines. If
// they ran to 1, narrow patches would take the bends of long ones; at full length, long curves
// would waver.
#include "drawing/bend.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>

#include "surface/terms.hpp"

namespace sweepface::drawing {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Row = std::vector<Term>;

// Small enough that curves keep to their points, large enough that rounding does not decide.
constexpr double kBending = 1e-8;

// Gauss-Legendre points and weights on [0, 1]: exact for squares of derivatives of quintics, and
// nearly so for squares of quintics: S_uu is one in v.
constexpr std::array<double, 5> kGauss{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                       0.953089922969332};
constexpr std::array<double, 5> kGaussWeight{
    0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683, 0.118463442528095};

class Bender {
 public:
  Bender(const Surface& surface, const std::vector<PatchSize>& sizes,
         const std::vector<bool>& known, std::vector<Pose>& poses)
      : surface_(surface),
        sizes_(sizes),
        poses_(poses),
        column_(known.size(), -1),
        rows_(inStoredVectors(surface)) {
    for (std::size_t v = 0; v < known.size(); ++v)
      if (!known[v]) column_[v] = unknowns_++;
    rhs_ = Matrix::Zero(unknowns_, static_cast<Index>(3 * poses.size()));
  }

  Result<void> solve(const Wishes& wishes) {
    if (unknowns_ == 0) return {};
    for (std::size_t k = 0; k < wishes.sums.size(); ++k) addWish(wishes, k);
    for (Index p = 0; p < surface_.patchCount(); ++p) addBending(p);
    return factorise();
  }

 private:
  void addWish(const Wishes& wishes, std::size_t k) {
    const Row row = expanded(wishes.sums[k], rows_);
    for (const Term& a : row) {
      if (column_[a.vector] < 0) continue;
      for (std::size_t pose = 0; pose < poses_.size(); ++pose)
        addToRhs(a.vector, pose, a.factor * wishes.places[pose][k]);
      for (const Term& b : row) add(a.vector, b.vector, a.factor * b.factor);
    }
  }

  void addBending(Index p) {
    const auto vectors = surface_.weights({p, 0, 0}).vectors;
    std::vector<Index> stored;
    for (Index v : vectors)
      for (const Term& t : rows_[v]) stored.push_back(t.vector);
    std::ranges::sort(stored);
    stored.erase(std::unique(stored.begin(), stored.end()), stored.end());
    if (std::ranges::all_of(stored, [&](Index v) { return column_[v] < 0; })) return;
    Matrix spread = Matrix::Zero(36, static_cast<Index>(stored.size()));
    for (int k = 0; k < 36; ++k)
      for (const Term& t : rows_[vectors[k]])
        spread(k, std::ranges::lower_bound(stored, t.vector) - stored.begin()) += t.factor;
    const Matrix energy = spread.transpose() * bendingOf(p) * spread;
    for (std::size_t a = 0; a < stored.size(); ++a)
      for (std::size_t b = 0; b < stored.size(); ++b)
        add(stored[a], stored[b], energy(static_cast<Index>(a), static_cast<Index>(b)));
  }

  // The energy of a patch in its own 36 vectors.
  Matrix bendingOf(Index p) const {
    const double m = surface_.edgesU(p), n = surface_.edgesV(p);
    const double length = std::sqrt(sizes_[p].u), width = std::sqrt(sizes_[p].v);
    Matrix samples(75, 36);
    int row = 0;
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j)
        for (int du = 0; du <= 2; ++du, ++row) {
          const auto w = surface_.weights({p, kGauss[i] * m, kGauss[j] * n}, du, 2 - du);
          const double scale =
              std::sqrt(kBending * kGaussWeight[i] * kGaussWeight[j] * (du == 1 ? 2 : 1)) *
              std::pow(m / length, du) * std::pow(n / width, 2 - du) * std::sqrt(length * width);
          for (int k = 0; k < 36; ++k) samples(row, k) = scale * w.factors[k];
        }
    return samples.transpose() * samples;
  }

  // Adds an entry of the normal equations. What belongs to a known vector goes to the right-hand
  // side.
  void add(Index a, Index b, double value) {
    if (column_[a] < 0 || value == 0) return;
    if (column_[b] >= 0) return entries_.emplace_back(column_[a], column_[b], value), void();
    for (std::size_t pose = 0; pose < poses_.size(); ++pose)
      addToRhs(a, pose, -value * poses_[pose][b]);
  }
  void addToRhs(Index a, std::size_t pose, const Vec3& v) {
    auto row = rhs_.row(column_[a]);
    const auto k = static_cast<Index>(3 * pose);
    row[k] += v.x, row[k + 1] += v.y, row[k + 2] += v.z;
  }

  Result<void> factorise() {
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    for (Index k = 0; k < unknowns_; ++k) entries_.emplace_back(k, k, 0);  // room for the diagonal
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    // Vectors that move nothing, such as the derivatives of a node where two patches meet, stay
    // zero.
    for (Index k = 0; k < unknowns_; ++k)
      if (matrix.coeff(k, k) == 0) matrix.coeffRef(k, k) = 1;
    // Bring derivatives of every order to the same scale.
    Eigen::VectorXd scale(unknowns_);
    for (Index k = 0; k < unknowns_; ++k)
      scale[k] = 1 / std::sqrt(std::max(matrix.coeff(k, k), 1e-300));
    matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return fail("the curves do not determine the surface");
    const Eigen::MatrixXd scaled = scale.asDiagonal() * rhs_;
    Eigen::MatrixXd solution = factor.solve(scaled);
    solution += factor.solve(scaled - matrix * solution);  // one step of iterative refinement
    solution = scale.asDiagonal() * solution;
    if (!solution.allFinite()) return fail("the curves do not determine the surface");
    for (std::size_t v = 0; v < column_.size(); ++v)
      for (std::size_t pose = 0; pose < poses_.size() && column_[v] >= 0; ++pose) {
        const auto s = solution.row(column_[v]).segment<3>(static_cast<Index>(3 * pose));
        poses_[pose][v] = {s[0], s[1], s[2]};
      }
    return {};
  }

  const Surface& surface_;
  const std::vector<PatchSize>& sizes_;
  std::vector<Pose>& poses_;
  std::vector<Index> column_;  // [storedCount] the column of an unknown, or -1
  Index unknowns_ = 0;
  std::vector<Row> rows_;  // [vectorCount]
  std::vector<Eigen::Triplet<double>> entries_;
  Matrix rhs_;  // [unknowns × 3·poses]
};

}  // namespace

Result<void> bendLeast(const Surface& surface, const std::vector<PatchSize>& sizes,
                       const std::vector<bool>& known, const Wishes& wishes,
                       std::vector<Pose>& poses) {
  return Bender(surface, sizes, known, poses).solve(wishes);
}

}  // namespace sweepface::drawing
