#pragma once

#include "fit/draft.hpp"
#include "fit/source_data.hpp"

namespace sweepface {

/// The stored vectors of all poses.
using Solution = PoseMatrix;  ///< [storedCount × 3·poses]

/// Least squares for all poses at once, with one factorisation: positions at source vertices,
/// tangents there that agree with the source's normals, smooth estimates half-way between vertices,
/// and a small penalty on third derivatives at the scale of the mesh.
Result<Solution> solve(const Layout& layout, const Draft& draft, const SourceData& data);

/// The 36 corner vectors of a patch, all poses, in the order of Surface::weights.
PoseMatrix patchVectors(const Draft& draft, Index patch, const PoseMatrix& settled);
/// All vectors of all poses [vectorCount × 3·poses].
PoseMatrix settleAll(const Surface& surface, const Solution& solution);

}  // namespace sweepface
