#pragma once

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Places on a face: the vertices of a tessellation, then the loose vertices.
struct MorphShape {
  std::vector<Vec3> positions;  ///< [vertices + loose]
  std::vector<Vec3> normals;    ///< [vertices + loose], unit; empty if not asked for
};

/// The neutral, and what each target at weight 1 adds to it.
class MorphShapes {
 public:
  /// Both must outlive this.
  MorphShapes(const Rig& rig, const Tessellation& grid);

  /// The place of a vertex of the source, in the order of MorphShape.
  Index placeOf(Index sourceVertex) const;
  const MorphShape& neutral() const { return neutral_; }
  /// Differences from the neutral, exactly zero wherever the target moves nothing; all of them for
  /// target -1. Thread-safe.
  MorphShape target(Index target, bool withNormals) const;

 private:
  std::vector<Vec3> normals(std::span<const Vec3> vectors) const;

  const Rig& rig_;
  const Tessellation& grid_;
  MorphShape neutral_;
};

}  // namespace sweepface
