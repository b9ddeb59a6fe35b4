#include "lod_mesh.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "sweepface/io.hpp"
#include "sweepface/lod_polygons.hpp"

#include "command.hpp"

namespace sweepface::cli {

Result<void> checkFineness(const Surface& surface, Index lod) {
  const double quads = static_cast<double>(surface.wireframe().quadCount()) * lod * lod;
  if (quads <= kMostQuads) return {};
  return fail(
      fmt::format("At --lod {} the face would have {:.1f} million quads, of which {:.0f} "
                  "million are the most; give a lower one.",
                  lod, quads / 1e6, kMostQuads / 1e6));
}

Result<void> checkLod(const Rig& rig, Index lod) {
  if (lod == 0) return {};
  if (!rig.source.quadCorners.empty()) return checkFineness(rig.surface, lod);
  return fail(
      "The face does not tell of its source's polygons, which --lod cuts; convert it again.");
}

MeshMaker::MeshMaker(const Rig& rig, Index lod)
    : rig_(rig),
      lod_(lod),
      grid_(rig.surface, std::max(lod, 1)),
      polygons_(lod == 0 ? rig.source.polygons : lodPolygons(rig, grid_)) {}

std::string MeshMaker::obj(std::span<const double> weights) const {
  const auto [positions, normals] = shape(weights);
  return formatObj({positions, normals, polygons_});
}

std::string MeshMaker::obj(std::span<const double> weights, const Quaternion& by,
                           const Vec3& pivot) const {
  auto [positions, normals] = shape(weights);
  for (Vec3& p : positions) p = pivot + turned(by, p - pivot);
  for (Vec3& n : normals) n = turned(by, n);
  return formatObj({positions, normals, polygons_});
}

MeshMaker::Shape MeshMaker::shape(std::span<const double> weights) const {
  const std::vector<Vec3> vectors = blend(rig_, weights);
  if (lod_ > 0) return {grid_.positions(vectors), grid_.normals(vectors)};
  return {sourcePositions(rig_, grid_, vectors, weights), sourceNormals(rig_, grid_, vectors)};
}

}  // namespace sweepface::cli
