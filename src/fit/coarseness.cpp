#include "fit/coarseness.hpp"

#include <cmath>
#include <vector>

#include "fit/vertex_normals.hpp"
#include "mesh/median.hpp"

namespace sweepface {

Coarseness coarsenessOf(const PolygonMesh& mesh) {
  const Polygons& faces = mesh.polygons;
  const auto at = [&](Index corner) { return mesh.positions[faces.corners[corner]]; };
  const std::vector<Vec3> normals = vertexNormals(faces, mesh.positions, faces.corners,
                                                  static_cast<Index>(mesh.positions.size()), {});
  std::vector<double> angles, heights;
  for (Index f = 0; f < faces.faceCount(); ++f) {
    const Index first = faces.faceStart[f], end = faces.faceStart[f + 1];
    Vec3 area, mean;
    for (Index c = first; c < end; ++c) {
      area += 0.5 * cross(at(c) - at(first), at(c + 1 < end ? c + 1 : first) - at(first));
      mean += normals[faces.corners[c]];
    }
    if (!(norm(area) > 0 && norm(mean) > 0)) continue;
    angles.push_back(angleDegrees(area, mean));
    heights.push_back(norm(cross(area, normalized(mean))) / std::sqrt(norm(area)));
  }
  return {median(std::move(angles)), median(std::move(heights))};
}

}  // namespace sweepface
