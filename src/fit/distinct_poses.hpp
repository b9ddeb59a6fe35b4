#pragma once

#include <vector>

#include "fit/source_data.hpp"

namespace sweepface {

/// The poses of a matrix [rows × 3·poses] without those equal to the first. Most expressions leave
/// most of a face still, so equal poses are computed only once.
class DistinctPoses {
 public:
  DistinctPoses() = default;
  explicit DistinctPoses(const PoseMatrix& all) : columns_(all.cols() / 3, 0) {
    for (Index k = 0; k < static_cast<Index>(columns_.size()); ++k) {
      if (k > 0 && all.middleCols<3>(3 * k) == all.leftCols<3>()) continue;
      columns_[k] = 3 * static_cast<Index>(poses_.size());
      poses_.push_back(k);
    }
  }

  /// [rows × 3·distinct]
  PoseMatrix of(const PoseMatrix& all) const {
    PoseMatrix result(all.rows(), 3 * poses_.size());
    for (std::size_t k = 0; k < poses_.size(); ++k)
      result.middleCols<3>(static_cast<Index>(3 * k)) = all.middleCols<3>(3 * poses_[k]);
    return result;
  }

  /// The column of a pose's x in that matrix.
  Index column(Index pose) const { return columns_[pose]; }

 private:
  std::vector<Index> poses_, columns_;
};

}  // namespace sweepface
