#include "fit/assemble.hpp"

#include "sweepface/eval.hpp"

namespace sweepface {

namespace {

// The vertex of level 1 at each point.
std::vector<Index> verticesOfPoints(const GridMesh& mesh, const Draft& draft) {
  const Tessellation grid(draft.surface, 1);
  std::vector<Index> vertices(mesh.pointCount(), -1);
  for (Index p = 0; p < draft.surface.patchCount(); ++p) {
    const GridPatch& patch = draft.patches[p];
    for (Index j = 0; j <= patch.n; ++j)
      for (Index i = 0; i <= patch.m; ++i)
        vertices[mesh.point[patch.vertex(i, j)]] = grid.vertex(p, i, j);
  }
  return vertices;
}

std::vector<Index> quadCorners(const GridMesh& mesh, const std::vector<GridPatch>& patches) {
  std::vector<Index> corners;
  for (const GridPatch& patch : patches)
    for (std::size_t q = 0; q < patch.quads.size(); ++q)
      for (int k = 0; k < 4; ++k)
        corners.push_back(mesh.quadCorners[patch.quads[q]][((patch.bottoms[q] & 3) + k) % 4]);
  return corners;
}

void placeVertices(Rig& rig, const MeshRig& source, const GridMesh& mesh,
                   const std::vector<Index>& vertexOfPoint) {
  const auto& positions = source.neutral.positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (const Index point = mesh.pointOfSource[v]; point >= 0) {
      rig.source.gridVertex.push_back(vertexOfPoint[point]);
      continue;
    }
    rig.source.gridVertex.push_back(-1 - static_cast<Index>(rig.source.loose.size()));
    rig.source.loose.push_back(positions[v]);
    for (std::size_t k = 0; k < rig.targets.size(); ++k)
      rig.targets[k].looseDifference.push_back(source.targets[k].positions[v] - positions[v]);
  }
}

}  // namespace

Rig assemble(const MeshRig& source, const GridMesh& mesh, Fitted fitted) {
  const auto& [draft, solution] = fitted;
  Rig rig;
  const auto vectors = static_cast<Index>(solution.rows());
  for (Index v = 0; v < vectors; ++v) rig.neutral.push_back(SourceData::at(solution, v, 0));
  for (const MeshTarget& shape : source.targets) {
    Target target{shape.name, {}, {}};
    const Index pose = 1 + static_cast<Index>(rig.targets.size());
    for (Index v = 0; v < vectors; ++v)
      target.difference.push_back(SourceData::at(solution, v, pose) - rig.neutral[v]);
    rig.targets.push_back(std::move(target));
  }
  placeVertices(rig, source, mesh, verticesOfPoints(mesh, draft));
  rig.source.quadCorners = quadCorners(mesh, draft.patches);
  rig.source.polygons = source.neutral.polygons;
  rig.surface = std::move(fitted.draft.surface);
  return rig;
}

}  // namespace sweepface
