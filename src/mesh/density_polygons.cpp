#include <map>

#include "sweepface/lod_polygons.hpp"
#include "sweepface/render_mesh.hpp"

namespace sweepface {
namespace {

/// What an OBJ records about a face.
struct FaceKind {
  Index material = -1, group = -1;
  bool isTextured = false;
  auto operator<=>(const FaceKind&) const = default;
};

/// The kind of every face of a source.
class FaceKinds {
 public:
  explicit FaceKinds(const Polygons& source) {
    std::map<FaceKind, Index> numbers;
    for (Index f = 0; f < source.faceCount(); ++f) {
      const FaceKind kind{source.faceMaterial.empty() ? -1 : source.faceMaterial[f],
                          source.faceGroup.empty() ? -1 : source.faceGroup[f],
                          isTextured(source, f)};
      const auto [known, isNew] = numbers.emplace(kind, static_cast<Index>(kinds_.size()));
      if (isNew) kinds_.push_back(kind);
      ofFace_.push_back(known->second);
    }
  }

  const std::vector<Index>& ofFaces() const { return ofFace_; }
  std::size_t count() const { return kinds_.size(); }
  FaceKind at(Index kind) const { return kind < 0 ? FaceKind{} : kinds_[kind]; }

 private:
  static bool isTextured(const Polygons& source, Index face) {
    for (Index c = source.faceStart[face]; c < source.faceStart[face + 1]; ++c)
      if (source.cornerTexcoords.empty() || source.cornerTexcoords[c] < 0) return false;
    return true;
  }

  std::vector<FaceKind> kinds_;
  std::vector<Index> ofFace_;
};

/// A tessellation's triangles, with a part for every kind of face rather than for every material.
RenderMesh renderByKind(const Rig& rig, const FaceKinds& kinds, const Tessellation& grid) {
  Rig painted;
  painted.surface = rig.surface, painted.neutral = rig.neutral, painted.source = rig.source;
  painted.source.polygons.materials.assign(kinds.count(), "");
  painted.source.polygons.faceMaterial = kinds.ofFaces();
  return renderDensity(painted, grid);
}

}  // namespace

Polygons densityPolygons(const Rig& rig, const Tessellation& grid) {
  const Polygons& source = rig.source.polygons;
  const FaceKinds kinds(source);
  const RenderMesh mesh = renderByKind(rig, kinds, grid);
  Polygons result;
  result.materials = source.materials, result.groups = source.groups;
  result.materialFiles = source.materialFiles;
  for (std::size_t t = 0; t < mesh.texcoords.size(); t += 2)
    result.texcoords.push_back({mesh.texcoords[t], mesh.texcoords[t + 1]});
  for (const RenderMesh::Part& part : mesh.parts) {
    const FaceKind kind = kinds.at(part.material);
    for (std::uint32_t c = 3 * part.firstTriangle; c < 3 * (part.firstTriangle + part.triangles);
         ++c) {
      const auto vertex = static_cast<Index>(mesh.triangles[c]);
      result.corners.push_back(vertex < mesh.points ? vertex : mesh.copies[vertex - mesh.points]);
      if (!mesh.texcoords.empty()) result.cornerTexcoords.push_back(kind.isTextured ? vertex : -1);
      if (c % 3 < 2) continue;
      result.faceStart.push_back(static_cast<Index>(result.corners.size()));
      if (!result.materials.empty()) result.faceMaterial.push_back(kind.material);
      if (!result.groups.empty()) result.faceGroup.push_back(kind.group);
    }
  }
  return result;
}

}  // namespace sweepface
