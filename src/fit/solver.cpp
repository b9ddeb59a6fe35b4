#include "fit/solver.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "fit/distinct_poses.hpp"
#include "parallel/parallel.hpp"
#include "surface/terms.hpp"

namespace sweepface {

namespace {

using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SparseRow = std::vector<Term>;

// How much a sample counts beside a vertex.
constexpr double kOneSidedTangent = 0.1;
constexpr double kBetweenWeight = 0.05;
constexpr double kSmoothWeight = 1e-4;

// The normal equations of one patch in its own 36 vectors, then in the stored vectors it depends
// on.
struct PatchEquations {
  std::vector<Index> unknowns;
  Dense matrix;    // [unknowns × unknowns]
  PoseMatrix rhs;  // [unknowns × 3·distinct poses]
  DistinctPoses poses;
};

class PatchAssembler {
 public:
  PatchAssembler(const Layout& layout, const Draft& draft, const SourceData& data, Index patch,
                 const std::vector<Index>& owner)
      : layout_(layout),
        mesh_(layout.mesh()),
        surface_(draft.surface),
        grid_(draft.patches[patch]),
        data_(data),
        patch_(patch),
        owner_(owner) {
    const Index samples = 8 * (grid_.m + 1) * (grid_.n + 1);
    rows_.reserve(samples);
  }

  PatchEquations assemble(const std::vector<SparseRow>& expanded) {
    for (Index j = 0; j <= grid_.n; ++j)
      for (Index i = 0; i <= grid_.m; ++i)
        if (owner_[grid_.vertex(i, j)] == patch_) addVertex(i, j);
    addHubTangents();
    addBetween();
    addSmoothness();
    return reduce(expanded);
  }

 private:
  struct Sample {
    Surface::Weights weights;
    double weight;
    PoseRow value;  // empty: zero
  };

  double weightAt(Index i, Index j) const { return data_.weight[mesh_.point[grid_.vertex(i, j)]]; }
  double slopeWeight(Index vertex) const {
    return data_.slopeWeight * data_.slopeEmphasis[mesh_.point[vertex]];
  }
  auto valueOf(Index vertex) const { return data_.points.row(mesh_.point[vertex]); }

  void add(double u, double v, int du, int dv, double weight, PoseRow value) {
    rows_.push_back({surface_.weights({patch_, u, v}, du, dv), weight, std::move(value)});
  }

  void addVertex(Index i, Index j) {
    const Index vertex = grid_.vertex(i, j);
    const double weight = weightAt(i, j);
    add(i, j, 0, 0, weight * data_.placeEmphasis[mesh_.point[vertex]], valueOf(vertex));
    if (!layout_.isRegular(vertex)) return;
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = [&](Index d) -> Index {
        const Index a = i + (axis == 0 ? d : 0), b = j + (axis == 1 ? d : 0);
        return a < 0 || b < 0 || a > grid_.m || b > grid_.n ? -1 : grid_.vertex(a, b);
      };
      Index ahead = at(1), behind = at(-1);
      if (ahead < 0) ahead = layout_.beyond(vertex, behind);
      if (behind < 0) behind = layout_.beyond(vertex, ahead);
      const bool central = ahead >= 0 && behind >= 0;
      PoseRow slope = valueOf(ahead >= 0 ? ahead : vertex) - valueOf(behind >= 0 ? behind : vertex);
      if (central) slope *= 0.5;
      turnIntoTangentPlane(slope, vertex, false);
      if (central && data_.uneven[vertex]) limitLength(slope, vertex, ahead, behind);
      add(i, j, axis == 0, axis == 1,
          weight * slopeWeight(vertex) * (central ? 1 : kOneSidedTangent), std::move(slope));
    }
  }

  // Around an irregular node every patch contributes its own two spokes.
  void addHubTangents() {
    for (int corner = 0; corner < 4; ++corner) {
      const Index i = corner == 1 || corner == 2 ? grid_.m : 0, j = corner >= 2 ? grid_.n : 0;
      const Index vertex = grid_.vertex(i, j);
      if (layout_.isRegular(vertex)) continue;
      for (int axis = 0; axis < 2; ++axis) {
        const Index other =
            axis == 0 ? grid_.vertex(i ? i - 1 : 1, j) : grid_.vertex(i, j ? j - 1 : 1);
        if (mesh_.point[other] == mesh_.point[vertex]) continue;  // a collapsed side
        PoseRow slope = valueOf(other) - valueOf(vertex);
        if ((axis == 0 ? i : j) > 0) slope *= -1;
        turnIntoTangentPlane(slope, vertex, true);
        add(i, j, axis == 0, axis == 1, weightAt(i, j) * slopeWeight(vertex), std::move(slope));
      }
    }
  }

  // Removes the part along the source's normal; keeps the length on request.
  void turnIntoTangentPlane(PoseRow& slope, Index vertex, bool keepLength) const {
    const Index p = mesh_.point[vertex];
    for (Index k = 0; k < data_.poses; ++k) {
      auto s = slope.segment<3>(3 * k);
      const auto n = data_.normals.row(p).segment<3>(3 * k);
      const double before = s.norm();
      s -= s.dot(n) * n;
      if (const double after = s.norm(); keepLength && after > 1e-9 * before) s *= before / after;
    }
  }

  // Where a short edge follows a long one the mean slope is several times the short edge, and a
  // curve with that slope turns back on itself. Twice the shorter edge is as steep as it may be.
  void limitLength(PoseRow& slope, Index vertex, Index ahead, Index behind) const {
    for (Index k = 0; k < data_.poses; ++k) {
      const auto at = [&](Index v) { return valueOf(v).template segment<3>(3 * k); };
      const double most =
          2 * std::min((at(ahead) - at(vertex)).norm(), (at(vertex) - at(behind)).norm());
      auto s = slope.segment<3>(3 * k);
      if (const double length = s.norm(); most > 0 && length > most) s *= most / length;
    }
  }

  // Half-way along an edge, by the cubic through four vertices of its line where there are four.
  struct Middle {
    PoseRow value;
    double trust;
  };
  Middle middle(Index b, Index c) const {
    const Index a = layout_.beyond(b, c), d = layout_.beyond(c, b);
    if (a >= 0 && d >= 0)
      return {(9 * (valueOf(b) + valueOf(c)) - valueOf(a) - valueOf(d)) / 16, 1};
    if (a >= 0) return {-0.125 * valueOf(a) + 0.75 * valueOf(b) + 0.375 * valueOf(c), 0.5};
    if (d >= 0) return {-0.125 * valueOf(d) + 0.75 * valueOf(c) + 0.375 * valueOf(b), 0.5};
    return {0.5 * (valueOf(b) + valueOf(c)), 0.1};
  }

  void addBetween() {
    const Index m = grid_.m, n = grid_.n;
    std::vector<Middle> alongU, alongV;
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i < m; ++i)
        alongU.push_back(middle(grid_.vertex(i, j), grid_.vertex(i + 1, j)));
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i <= m; ++i)
        alongV.push_back(middle(grid_.vertex(i, j), grid_.vertex(i, j + 1)));
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < m; ++i) {
        const Middle &south = alongU[j * m + i], &north = alongU[(j + 1) * m + i];
        const Middle &west = alongV[j * (m + 1) + i], &east = alongV[j * (m + 1) + i + 1];
        const double w = kBetweenWeight * weightAt(i, j);
        add(i + 0.5, j, 0, 0, w * south.trust * (j == 0 ? 0.5 : 1), south.value);
        add(i, j + 0.5, 0, 0, w * west.trust * (i == 0 ? 0.5 : 1), west.value);
        if (j == n - 1) add(i + 0.5, n, 0, 0, w * north.trust * 0.5, north.value);
        if (i == m - 1) add(m, j + 0.5, 0, 0, w * east.trust * 0.5, east.value);
        const PoseRow corners = valueOf(grid_.vertex(i, j)) + valueOf(grid_.vertex(i + 1, j)) +
                                valueOf(grid_.vertex(i, j + 1)) +
                                valueOf(grid_.vertex(i + 1, j + 1));
        add(i + 0.5, j + 0.5, 0, 0,
            w * std::min({south.trust, north.trust, west.trust, east.trust}),
            0.5 * (south.value + north.value + west.value + east.value) - 0.25 * corners);
      }
  }

  void addSmoothness() {
    for (Index j = 0; j < grid_.n; ++j)
      for (Index i = 0; i < grid_.m; ++i)
        for (int d = 0; d <= 3; ++d)
          add(i + 0.5, j + 0.5, d, 3 - d,
              kSmoothWeight * weightAt(i, j) * (d == 1 || d == 2 ? 3 : 1), {});
  }

  PatchEquations reduce(const std::vector<SparseRow>& expanded) const {
    PatchEquations e;
    const auto& vectors = rows_.front().weights.vectors;
    for (Index v : vectors)
      for (const Term& t : expanded[v]) e.unknowns.push_back(t.vector);
    std::sort(e.unknowns.begin(), e.unknowns.end());
    e.unknowns.erase(std::unique(e.unknowns.begin(), e.unknowns.end()), e.unknowns.end());
    Dense spread = Dense::Zero(36, static_cast<Index>(e.unknowns.size()));
    for (int k = 0; k < 36; ++k)
      for (const Term& t : expanded[vectors[k]])
        spread(k, std::lower_bound(e.unknowns.begin(), e.unknowns.end(), t.vector) -
                      e.unknowns.begin()) += t.factor;

    const auto count = static_cast<Index>(rows_.size());
    // Those that ask for smoothness come last; they ask for zeros.
    const auto valued = static_cast<Index>(
        std::ranges::find_if(rows_, [](const Sample& s) { return s.value.size() == 0; }) -
        rows_.begin());
    Dense basis(count, 36);
    PoseMatrix values(valued, 3 * data_.poses);
    for (Index r = 0; r < count; ++r) {
      const double s = std::sqrt(rows_[r].weight);
      for (int k = 0; k < 36; ++k) basis(r, k) = s * rows_[r].weights.factors[k];
      if (r < valued) values.row(r) = s * rows_[r].value;
    }
    e.poses = DistinctPoses(values);
    const Dense local = basis.transpose() * basis;
    const PoseMatrix localRhs = basis.topRows(valued).transpose() * e.poses.of(values);
    e.matrix.noalias() = spread.transpose() * (local * spread);
    e.rhs.noalias() = spread.transpose() * localRhs;
    return e;
  }

  const Layout& layout_;
  const GridMesh& mesh_;
  const Surface& surface_;
  const GridPatch& grid_;
  const SourceData& data_;
  Index patch_;
  const std::vector<Index>& owner_;
  std::vector<Sample> rows_;
};

// The first patch that holds a vertex speaks for it.
std::vector<Index> vertexOwners(const Draft& draft, Index vertexCount) {
  std::vector<Index> owner(vertexCount, -1);
  for (std::size_t p = 0; p < draft.patches.size(); ++p)
    for (Index v : draft.patches[p].vertices)
      if (owner[v] < 0) owner[v] = static_cast<Index>(p);
  return owner;
}

using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr Index kBlock = 12;  // columns that are solved for at once
using Block = Eigen::Matrix<double, Eigen::Dynamic, kBlock, Eigen::RowMajor>;

// L D Lᵀ x = what is there, in all columns at once: Eigen's own walks through L for each of them. L
// is held without its diagonal of ones.
void substitute(const Eigen::SimplicialLDLT<SparseMatrix>& factor, Block& x) {
  const auto& lower = factor.matrixL().nestedExpression();
  for (Eigen::Index k = 0; k < lower.cols(); ++k)
    for (SparseMatrix::InnerIterator it(lower, k); it; ++it)
      x.row(it.row()) -= it.value() * x.row(k);
  x.array().colwise() /= factor.vectorD().array();
  for (Eigen::Index k = lower.cols(); k-- > 0;)
    for (SparseMatrix::InnerIterator it(lower, k); it; ++it)
      x.row(k) -= it.value() * x.row(it.row());
}

Result<Solution> solveScaled(SparseMatrix& matrix, const PoseMatrix& rhs) {
  const auto n = static_cast<Index>(matrix.rows());
  Eigen::VectorXd scale(n);
  for (Index k = 0; k < n; ++k) scale[k] = 1 / std::sqrt(std::max(matrix.coeff(k, k), 1e-300));
  for (Index k = 0; k < n; ++k)
    for (SparseMatrix::InnerIterator it(matrix, k); it; ++it)
      it.valueRef() =
          it.value() * scale[it.row()] * scale[it.col()] + (it.row() == it.col() ? 1e-11 : 0);
  Eigen::SimplicialLDLT<SparseMatrix> factor(matrix);
  if (factor.info() != Eigen::Success)
    return fail("the fit cannot be solved; are there coordinates of wildly different size?");
  Solution solution(n, rhs.cols());
  const auto blocks = static_cast<Index>((rhs.cols() + kBlock - 1) / kBlock);
  parallelFor(Index{0}, blocks, [&](Index b) {
    const Index first = b * kBlock,
                columns = std::min<Index>(kBlock, static_cast<Index>(rhs.cols()) - first);
    Block x = Block::Zero(n, kBlock);
    x.leftCols(columns) =
        factor.permutationP() * (scale.asDiagonal() * rhs.middleCols(first, columns));
    substitute(factor, x);
    solution.middleCols(first, columns) =
        scale.asDiagonal() * (factor.permutationPinv() * x.leftCols(columns));
  });
  return solution;
}

}  // namespace

Result<Solution> solve(const Layout& layout, const Draft& draft, const SourceData& data) {
  const std::vector<SparseRow> expanded = inStoredVectors(draft.surface);
  const std::vector<Index> owner = vertexOwners(draft, layout.mesh().vertexCount());
  const Index unknowns = draft.surface.storedCount();
  PoseMatrix rhs = PoseMatrix::Zero(unknowns, 3 * data.poses);
  std::vector<Eigen::Triplet<double>> entries;
  // In batches: the patches' equations are large, and adding them up in order keeps the bytes the
  // same for any number of threads.
  constexpr Index kBatch = 64;
  for (Index first = 0; first < draft.surface.patchCount(); first += kBatch) {
    const Index count = std::min(kBatch, draft.surface.patchCount() - first);
    std::vector<PatchEquations> batch(count);
    parallelFor(Index{0}, count, [&](Index k) {
      batch[k] = PatchAssembler(layout, draft, data, first + k, owner).assemble(expanded);
    });
    for (const PatchEquations& e : batch)
      for (std::size_t a = 0; a < e.unknowns.size(); ++a) {
        for (Index k = 0; k < data.poses; ++k)
          rhs.row(e.unknowns[a]).segment<3>(3 * k) +=
              e.rhs.row(static_cast<Index>(a)).segment<3>(e.poses.column(k));
        for (std::size_t b = 0; b <= a; ++b)
          entries.emplace_back(e.unknowns[a], e.unknowns[b],
                               e.matrix(static_cast<Index>(a), static_cast<Index>(b)));
      }
  }
  // What moves nothing is nothing: second derivatives where two patches meet back to back.
  for (Index k = 0; k < unknowns; ++k) entries.emplace_back(k, k, 0);
  SparseMatrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return solveScaled(matrix, rhs);
}

PoseMatrix settleAll(const Surface& surface, const Solution& solution) {
  PoseMatrix all(surface.vectorCount(), solution.cols());
  all.topRows(solution.rows()) = solution;
  for (Index v = surface.storedCount(); v < surface.vectorCount(); ++v) {
    all.row(v).setZero();
    for (const Term& t : surface.derivation(v)) all.row(v) += t.factor * all.row(t.vector);
  }
  return all;
}

PoseMatrix patchVectors(const Draft& draft, Index patch, const PoseMatrix& settled) {
  const auto vectors = draft.surface.weights({patch, 0, 0}).vectors;
  PoseMatrix result(36, settled.cols());
  for (int k = 0; k < 36; ++k) result.row(k) = settled.row(vectors[k]);
  return result;
}

}  // namespace sweepface
