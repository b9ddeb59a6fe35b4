#include "gltf/source_of_grid.hpp"

#include <algorithm>
#include <numeric>

#include "sweepface/eval.hpp"

namespace sweepface::gltf {

SourceMesh sourceOfGrid(const Rig& rig) {
  const Tessellation grid(rig.surface, 1);
  SourceMesh source;
  source.loose = rig.source.loose;
  source.gridVertex.resize(grid.vertexCount());
  std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
  for (Index k = 0; k < static_cast<Index>(source.loose.size()); ++k)
    source.gridVertex.push_back(-1 - k);
  Polygons& polygons = source.polygons;
  for (const std::array<Index, 4>& face : grid.faces()) {
    const Index start = polygons.faceStart.back();
    for (int k = 0; k < 4; ++k) {
      // Where a side is collapsed both its corners are the same one.
      if (polygons.corners.size() == static_cast<std::size_t>(start) ||
          (polygons.corners.back() != face[k] && polygons.corners[start] != face[k]))
        polygons.corners.push_back(face[k]);
      const auto begin = polygons.corners.begin() + start;
      source.quadCorners.push_back(static_cast<Index>(
          std::find(begin, polygons.corners.end(), face[k]) - polygons.corners.begin()));
    }
    polygons.faceStart.push_back(static_cast<Index>(polygons.corners.size()));
  }
  return source;
}

}  // namespace sweepface::gltf
