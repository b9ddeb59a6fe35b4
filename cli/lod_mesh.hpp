#pragma once

#include <string>

#include "sweepface/eval.hpp"
#include "sweepface/head.hpp"

namespace sweepface::cli {

/// Checks that cutting every edge into `lod` does not make too many quads.
Result<void> checkFineness(const Surface& surface, Index lod);
/// Checks that the source's polygons can be cut into `lod`: that the face has them, and that the
/// quads are not too many.
Result<void> checkLod(const Rig& rig, Index lod);

/// Makes meshes of a rig, all over the same polygons: the source's own at lod 0, else a
/// tessellation.
class MeshMaker {
 public:
  /// The rig must outlive the maker.
  MeshMaker(const Rig& rig, Index lod);

  const Polygons& polygons() const { return polygons_; }

  /// The expression as an OBJ text, with the surface's own normals.
  std::string obj(std::span<const double> weights) const;
  /// The same turned about a point.
  std::string obj(std::span<const double> weights, const Quaternion& by, const Vec3& pivot) const;

 private:
  struct Shape {
    std::vector<Vec3> positions, normals;
  };
  Shape shape(std::span<const double> weights) const;

  const Rig& rig_;
  Index lod_;
  Tessellation grid_;
  Polygons polygons_;
};

}  // namespace sweepface::cli
