#pragma once

#include "sweepface/eval.hpp"

#include "fit/facets.hpp"

namespace sweepface {

/// Finds where a rig's surface turns over against its source's faces (docs/error-metric.md).
class FoldFinder {
 public:
  explicit FoldFinder(const Rig& rig, const Tessellation& grid);

  /// The quads of `grid` (level 1) that fold in a pose of the rig whose source vertices are at
  /// `source`. Ascending; each is listed once for every sixteenth of it that folds.
  std::vector<Index> quads(std::span<const Vec3> vectors, std::span<const Vec3> source) const;

  /// The number of level-4 triangles that fold in that pose, two to a sixteenth of a quad.
  Index count(std::span<const Vec3> vectors, std::span<const Vec3> source) const;

  /// The vertices of such a quad.
  const std::array<Index, 4>& corners(Index quad) const { return corners_[quad]; }

 private:
  /// Calls `visit(quad, folded triangles)` for every sixteenth of a quad that folds.
  template <typename Visit>
  void visit(std::span<const Vec3> vectors, std::span<const Vec3> source, Visit visit) const;

  const Rig& rig_;
  Index vertexCount_;
  std::vector<std::array<Index, 4>> corners_;
  Tessellation fine_;
  std::vector<std::array<Index, 4>> fineFaces_;
  FaceMap map_;
};

}  // namespace sweepface
