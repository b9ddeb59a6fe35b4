#include "fit/folds.hpp"

#include "fit/vertex_normals.hpp"

namespace sweepface {

namespace {
constexpr Index kLevel = 4;  // of the tessellation whose triangles are looked at
}

FoldFinder::FoldFinder(const Rig& rig, const Tessellation& grid)
    : rig_(rig),
      grid_(grid),
      fine_(rig.surface, kLevel),
      fineFaces_(fine_.faces()),
      map_(rig.source) {}

std::vector<Index> FoldFinder::corners(std::span<const Vec3> vectors,
                                       std::span<const Vec3> source) const {
  const auto normals =
      vertexNormals(rig_.source.polygons, source, rig_.source.gridVertex, grid_.vertexCount());
  const Facets facets(rig_.source, map_, source, normals, rig_.tolerance);
  const std::vector<Vec3> positions = fine_.positions(vectors);
  std::vector<Index> found;
  std::size_t face = 0, quad = 0;
  for (Index p = 0; p < rig_.surface.patchCount(); ++p) {
    const Index m = rig_.surface.edgesU(p), n = rig_.surface.edgesV(p);
    for (Index j = 0; j < kLevel * n; ++j)
      for (Index i = 0; i < kLevel * m; ++i, ++face) {
        const Index a = i / kLevel, b = j / kLevel;
        if (facets.folds(fineFaces_[face], positions, map_.faceOfQuad[quad + b * m + a]) > 0)
          for (int k = 0; k < 4; ++k)
            found.push_back(grid_.vertex(p, a + (k == 1 || k == 2), b + (k >= 2)));
      }
    quad += static_cast<std::size_t>(m) * n;
  }
  return found;
}

}  // namespace sweepface
