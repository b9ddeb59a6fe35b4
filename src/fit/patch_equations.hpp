#pragma once

#include <span>
#include <vector>

#include "fit/distinct_poses.hpp"
#include "fit/draft.hpp"
#include "fit/source_data.hpp"

namespace sweepface {

/// The normal equations of a patch in the stored vectors that it depends on. They ask for the
/// positions of its source vertices, the tangents there, estimates in between, and smoothness.
struct PatchEquations {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Index> unknowns;
  Matrix matrix;   ///< [unknowns × unknowns]
  PoseMatrix rhs;  ///< [unknowns × 3·distinct poses]
  DistinctPoses poses;
};

/// `owner` [vertices] is the patch whose equations include each vertex; `expanded` is every vector
/// as a combination of stored ones.
PatchEquations patchEquations(const Layout& layout, const Draft& draft, const SourceData& data,
                              Index patch, const std::vector<Index>& owner,
                              std::span<const std::vector<Term>> expanded);

}  // namespace sweepface
