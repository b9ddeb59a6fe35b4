#pragma once

#include <Eigen/Dense>
#include <algorithm>

namespace sweepface {

/// aᵀ b. Eigen adds up as many rows at once as the processor's first cache has room for, so that
/// sums of many rows are rounded differently on other processors. Here all of them add up alike.
template <typename A, typename B>
auto innerProduct(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  constexpr Eigen::Index kRows = 120;  // so few that any cache has room for them
  Eigen::Matrix<double, A::ColsAtCompileTime, B::ColsAtCompileTime, Eigen::RowMajor> sum;
  sum.setZero(a.cols(), b.cols());
  for (Eigen::Index row = 0; row < a.rows(); row += kRows) {
    const Eigen::Index count = std::min(kRows, a.rows() - row);
    sum.noalias() += a.middleRows(row, count).transpose() * b.middleRows(row, count);
  }
  return sum;
}

}  // namespace sweepface
