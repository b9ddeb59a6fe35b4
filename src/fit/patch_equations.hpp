#pragma once

#include <span>
#include <vector>

#include "fit/distinct_poses.hpp"
#include "fit/draft.hpp"
#include "fit/source_data.hpp"

namespace sweepface {

/// The normal equations of a patch in the stored vectors that it depends on: what its source
/// vertices, the tangents there and what lies between them ask of it, and of its smoothness.
struct PatchEquations {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Index> unknowns;
  Matrix matrix;   ///< [unknowns × unknowns]
  PoseMatrix rhs;  ///< [unknowns × 3·distinct poses]
  DistinctPoses poses;
};

/// `owner` [vertices] is the patch that speaks for each vertex; `expanded` is every vector as a
/// combination of stored ones.
PatchEquations patchEquations(const Layout& layout, const Draft& draft, const SourceData& data,
                              Index patch, const std::vector<Index>& owner,
                              std::span<const std::vector<Term>> expanded);

}  // namespace sweepface
