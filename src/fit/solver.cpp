#include "fit/solver.hpp"

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "fit/patch_equations.hpp"
#include "parallel/parallel.hpp"
#include "surface/terms.hpp"

namespace sweepface {

namespace {

// The first patch that has a vertex owns it.
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

// Solves L D Lᵀ x = b in place, for all columns at once; Eigen's own traverses L for each of them.
// L is stored without its diagonal of ones.
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

/// Adds up the right-hand sides of patches for the unknowns in [first, end), in the patches' order.
void addRows(const std::vector<PatchEquations>& batch, Index first, Index end, PoseMatrix& rhs) {
  const auto poses = static_cast<Index>(rhs.cols() / 3);
  for (const PatchEquations& e : batch)
    for (std::size_t a = 0; a < e.unknowns.size(); ++a) {
      if (e.unknowns[a] < first || e.unknowns[a] >= end) continue;
      for (Index k = 0; k < poses; ++k)
        rhs.row(e.unknowns[a]).segment<3>(3 * k) +=
            e.rhs.row(static_cast<Index>(a)).segment<3>(e.poses.column(k));
    }
}

/// The vectors that are derived, in lists: none depends on another of its list or on one of a later
/// list.
std::vector<std::vector<Index>> derivedInTurn(const Surface& surface) {
  std::vector<std::vector<Index>> lists;
  std::vector<std::size_t> turn(surface.vectorCount(), 0);  // 0: stored
  for (Index v = surface.storedCount(); v < surface.vectorCount(); ++v) {
    for (const Term& t : surface.derivation(v)) turn[v] = std::max(turn[v], turn[t.vector]);
    if (++turn[v] > lists.size()) lists.emplace_back();
    lists[turn[v] - 1].push_back(v);
  }
  return lists;
}

}  // namespace

Result<Solution> solve(const Layout& layout, const Draft& draft, const SourceData& data) {
  const auto expanded = inStoredVectors(draft.surface);
  const std::vector<Index> owner = vertexOwners(draft, layout.mesh().vertexCount());
  const Index unknowns = draft.surface.storedCount();
  PoseMatrix rhs = PoseMatrix::Zero(unknowns, 3 * data.poses);
  std::vector<Eigen::Triplet<double>> entries;
  // In batches: the patches' equations are large, and adding them up in order keeps the bytes the
  // same for any number of threads. Each thread adds up shares of the unknowns.
  constexpr Index kBatch = 64, kShares = 16;
  for (Index first = 0; first < draft.surface.patchCount(); first += kBatch) {
    const Index count = std::min(kBatch, draft.surface.patchCount() - first);
    std::vector<PatchEquations> batch(count);
    parallelFor(Index{0}, count, [&](Index k) {
      batch[k] = patchEquations(layout, draft, data, first + k, owner, expanded);
    });
    parallelFor(Index{0}, kShares, [&](Index share) {
      addRows(batch, share * unknowns / kShares, (share + 1) * unknowns / kShares, rhs);
    });
    for (const PatchEquations& e : batch)
      for (std::size_t a = 0; a < e.unknowns.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
          entries.emplace_back(e.unknowns[a], e.unknowns[b],
                               e.matrix(static_cast<Index>(a), static_cast<Index>(b)));
  }
  // Unknowns that move nothing become 0: second derivatives where two patches meet back to back.
  for (Index k = 0; k < unknowns; ++k) entries.emplace_back(k, k, 0);
  SparseMatrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return solveScaled(matrix, rhs);
}

PoseMatrix settleAll(const Surface& surface, const Solution& solution) {
  PoseMatrix all(surface.vectorCount(), solution.cols());
  parallelRanges(solution.rows(), [&](Eigen::Index first, Eigen::Index end) {
    all.middleRows(first, end - first) = solution.middleRows(first, end - first);
  });
  for (const std::vector<Index>& independent : derivedInTurn(surface))
    parallelRanges(independent.size(), [&](std::size_t first, std::size_t end) {
      for (std::size_t k = first; k < end; ++k) {
        auto row = all.row(independent[k]);
        row.setZero();
        for (const Term& t : surface.derivation(independent[k]))
          row += t.factor * all.row(t.vector);
      }
    });
  return all;
}

PoseMatrix patchVectors(const Draft& draft, Index patch, const PoseMatrix& settled) {
  const auto vectors = draft.surface.weights({patch, 0, 0}).vectors;
  PoseMatrix result(36, settled.cols());
  for (int k = 0; k < 36; ++k) result.row(k) = settled.row(vectors[k]);
  return result;
}

}  // namespace sweepface
