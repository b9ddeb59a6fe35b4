#include "fit/folds.hpp"

#include <algorithm>

#include "fit/vertex_normals.hpp"

namespace sweepface {

namespace {
constexpr Index kLevel = 4;  // of the tessellation whose triangles are looked at
}

FoldFinder::FoldFinder(const Rig& rig, const Tessellation& grid)
    : rig_(rig),
      vertexCount_(grid.vertexCount()),
      corners_(grid.faces()),
      fine_(rig.surface, kLevel),
      fineFaces_(fine_.faces()),
      map_(rig) {}

std::vector<Index> FoldFinder::quads(std::span<const Vec3> vectors,
                                     std::span<const Vec3> source) const {
  const auto normals =
      vertexNormals(rig_.source.polygons, source, rig_.source.gridVertex, vertexCount_);
  const Facets facets(rig_.source, map_, source, normals, rig_.tolerance);
  const std::vector<Vec3> positions = fine_.positions(vectors);
  std::vector<Index> found;
  std::size_t face = 0;
  Index first = 0;  // of the patch's quads
  for (Index p = 0; p < rig_.surface.patchCount(); ++p) {
    const Index m = rig_.surface.edgesU(p), n = rig_.surface.edgesV(p);
    for (Index j = 0; j < kLevel * n; ++j)
      for (Index i = 0; i < kLevel * m; ++i, ++face) {
        const Index quad = first + (j / kLevel) * m + i / kLevel;
        if (facets.folds(fineFaces_[face], positions, map_.faceOfQuad[quad]) > 0)
          found.push_back(quad);
      }
    first += m * n;
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace sweepface
