#include "fit/coarseness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit/median.hpp"
#include "fit/vertex_normals.hpp"

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
    const double size = norm(area) * norm(mean);
    if (!(size > 0)) continue;
    const double cosine = std::clamp(dot(area, mean) / size, -1.0, 1.0);
    angles.push_back(std::acos(cosine) * 180 / std::numbers::pi);
    heights.push_back(std::sqrt(norm(area) * (1 - cosine * cosine)));
  }
  return {median(std::move(angles)), median(std::move(heights))};
}

}  // namespace sweepface
