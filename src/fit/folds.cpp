#include "fit/folds.hpp"

#include <algorithm>

#include "sweepface/measure.hpp"

#include "eval/cells.hpp"
#include "fit/corner_places.hpp"
#include "fit/vertex_normals.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

FoldFinder::FoldFinder(const Rig& rig, const Tessellation& grid)
    : rig_(rig),
      vertexCount_(grid.vertexCount()),
      corners_(grid.faces()),
      fine_(rig.surface, kFineLevel),
      fineFaces_(fine_.faces()),
      map_(rig, cornerPlaces(rig.source, grid)) {}

template <typename Visit>
void FoldFinder::visit(std::span<const Vec3> vectors, std::span<const Vec3> source,
                       Visit visit) const {
  if (map_.faceOfQuad.empty()) return;  // it is not known which facet a quad belongs to
  const auto normals = vertexNormals(rig_.source.polygons, source, map_.cornerPlaces, vertexCount_,
                                     rig_.source.quadCorners);
  const Facets facets(rig_.source, map_, source, normals, rig_.tolerance);
  const std::vector<Vec3> positions = fine_.positions(vectors);
  forEachCell(rig_.surface, kFineLevel, [&](const Cell& cell) {
    const Index face = map_.faceOfQuad[cell.quad];
    if (const int folds = facets.folds(fineFaces_[cell.face], positions, face); folds > 0)
      visit(cell.quad, folds);
  });
}

std::vector<Index> FoldFinder::quads(std::span<const Vec3> vectors,
                                     std::span<const Vec3> source) const {
  std::vector<Index> found;
  visit(vectors, source, [&](Index quad, int) { found.push_back(quad); });
  std::ranges::sort(found);
  return found;
}

Index FoldFinder::count(std::span<const Vec3> vectors, std::span<const Vec3> source) const {
  Index count = 0;
  visit(vectors, source, [&](Index, int folds) { count += folds; });
  return count;
}

std::vector<Index> countFolds(const Rig& rig, const MeshRig& source) {
  const FoldFinder finder(rig, Tessellation(rig.surface, 1));
  std::vector<Index> folds(rig.targets.size() + 1);
  parallelFor(Index{0}, static_cast<Index>(folds.size()), [&](Index pose) {
    folds[pose] = finder.count(blend(rig, rig.weightsOf(pose)), source.positionsOf(pose));
  });
  return folds;
}

}  // namespace sweepface
