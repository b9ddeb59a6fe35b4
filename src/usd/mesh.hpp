#pragma once

#include "sweepface/usd.hpp"

#include "mesh/morph_shapes.hpp"
#include "usd/materials.hpp"
#include "usd/prim_names.hpp"
#include "usd/text.hpp"

namespace sweepface::usd {

/// Writes a rig's mesh with its blend shapes.
class MeshWriter {
 public:
  /// All must outlive this. The rig knows its faces, and the corners of its quads for a finer
  /// level; otherwise the vertices of its source are those of the grid.
  MeshWriter(const Rig& rig, const UsdOptions& options, const Tessellation& grid);

  const Materials& materials() const { return materials_; }
  /// Adds the mesh `name` to the prim at `path`, bound to the skeleton at `skeleton` unless that is
  /// empty. Fails if there is nothing to write, or numbers are beyond single precision.
  Result<void> add(Text& text, const std::string& path, const std::string& name,
                   const std::string& skeleton) const;

 private:
  void placePoints();
  std::vector<Vec3> placed(const std::vector<Vec3>& values) const;
  void addFaces(Text& text) const;
  void addTexcoords(Text& text) const;
  Result<void> addBlendShapes(Text& text, const std::string& path, const std::vector<Vec3>& points,
                              PrimNames& names) const;
  bool addBlendShape(Text& text, const std::string& prim, Index target, double least) const;

  const Rig& rig_;
  const UsdOptions& options_;
  const Tessellation& grid_;
  MorphShapes shapes_;
  Polygons polygons_;
  std::vector<Index> places_;  // [points] in the order of MorphShape
  std::vector<Index> faces_;   // those with three corners or more
  Materials materials_;
};

}  // namespace sweepface::usd
