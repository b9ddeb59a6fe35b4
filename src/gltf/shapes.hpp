#pragma once

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface::gltf {

/// Places on a face: the vertices of a tessellation, then the loose vertices.
struct ShapeAt {
  std::vector<Vec3> positions;  ///< [vertices + loose]
  std::vector<Vec3> normals;    ///< [vertices + loose], unit; empty if not asked for
};

/// The neutral, and what each target at weight 1 adds to it.
class Shapes {
 public:
  /// Both must outlive this.
  Shapes(const Rig& rig, const Tessellation& grid);

  /// The place of a vertex of the source, in the order of ShapeAt.
  Index placeOf(Index sourceVertex) const;
  const ShapeAt& neutral() const { return neutral_; }
  /// Differences from the neutral, exactly zero wherever the target moves nothing. Thread-safe.
  ShapeAt target(Index target, bool withNormals) const;

 private:
  std::vector<Vec3> normals(std::span<const Vec3> vectors) const;

  const Rig& rig_;
  const Tessellation& grid_;
  ShapeAt neutral_;
};

}  // namespace sweepface::gltf
