#include "budget_mesh.hpp"

#include "sweepface/io.hpp"
#include "sweepface/render_mesh.hpp"

namespace sweepface::cli {
namespace {

/// The triangles of a budgeted level of detail with the materials and texture coordinates of the
/// source.
Polygons polygonsOf(const Rig& rig, const RenderMesh& mesh) {
  Polygons result;
  result.materials = rig.source.polygons.materials;
  result.materialFiles = rig.source.polygons.materialFiles;
  for (std::size_t t = 0; t < mesh.texcoords.size(); t += 2)
    result.texcoords.push_back({mesh.texcoords[t], mesh.texcoords[t + 1]});
  for (const RenderMesh::Part& part : mesh.parts)
    for (std::uint32_t c = 3 * part.firstTriangle; c < 3 * (part.firstTriangle + part.triangles);
         ++c) {
      const auto vertex = static_cast<Index>(mesh.triangles[c]);
      result.corners.push_back(vertex < mesh.points ? vertex : mesh.copies[vertex - mesh.points]);
      if (!mesh.texcoords.empty()) result.cornerTexcoords.push_back(vertex);
      if (c % 3 < 2) continue;
      result.faceStart.push_back(static_cast<Index>(result.corners.size()));
      if (!result.materials.empty()) result.faceMaterial.push_back(part.material);
    }
  return result;
}

}  // namespace

Result<BudgetMesh> meshWithin(const Rig& rig, const Budget& budget,
                              std::span<const double> weights) {
  auto density = densityFor(rig.surface, blend(rig, {}), budget);
  if (!density) return std::unexpected(density.error());
  const Tessellation grid(rig.surface, std::move(*density));
  const Polygons polygons = polygonsOf(rig, renderDensity(rig, grid));
  const std::vector<Vec3> vectors = blend(rig, weights);
  const std::vector<Vec3> positions = grid.positions(vectors), normals = grid.normals(vectors);
  return BudgetMesh{formatObj({positions, normals, polygons}), grid.vertexCount(),
                    polygons.faceCount()};
}

}  // namespace sweepface::cli
