#include "fit/vertex_normals.hpp"

#include "eval/triangulate.hpp"

namespace sweepface {

std::vector<Vec3> vertexNormals(const Polygons& polygons, std::span<const Vec3> positions,
                                std::span<const Index> pointOf, Index pointCount) {
  std::vector<Vec3> normals(pointCount);
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index begin = polygons.faceStart[f], size = polygons.faceSize(f);
    // Reflex corners look the other way than their face; of quads and triangles none counts as one.
    const Vec3 face = size > 4 ? meanNormal(cornerPositions(polygons, positions, f)) : Vec3{};
    for (Index k = 0; k < size; ++k) {
      const Index v = polygons.corners[begin + k];
      const Vec3& p = positions[v];
      const Vec3 next = positions[polygons.corners[begin + (k + 1) % size]] - p;
      const Vec3 last = positions[polygons.corners[begin + (k + size - 1) % size]] - p;
      const Vec3 out = cross(next, last);
      if (const Index point = pointOf[begin + k]; point >= 0)
        normals[point] += dot(out, face) < 0 ? -1 * out : out;
    }
  }
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

std::vector<double> normalAngles(std::span<const Vec3> source, std::span<const Vec3> surface) {
  std::vector<double> angles;
  for (std::size_t v = 0; v < source.size(); ++v)
    if (norm(source[v]) != 0) angles.push_back(angleDegrees(surface[v], source[v]));
  return angles;
}

}  // namespace sweepface
