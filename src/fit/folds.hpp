#pragma once

#include "sweepface/eval.hpp"

#include "fit/facets.hpp"

namespace sweepface {

/// Finds where a rig's surface turns over against its source's faces (docs/error-metric.md).
class FoldFinder {
 public:
  explicit FoldFinder(const Rig& rig, const Tessellation& grid);

  /// The corners, as vertices of `grid` (level 1), of the quads that fold in a pose of the rig
  /// whose source has its vertices at `source`; each as often as it is one.
  std::vector<Index> corners(std::span<const Vec3> vectors, std::span<const Vec3> source) const;

 private:
  const Rig& rig_;
  const Tessellation& grid_;
  Tessellation fine_;
  std::vector<std::array<Index, 4>> fineFaces_;
  FaceMap map_;
};

}  // namespace sweepface
