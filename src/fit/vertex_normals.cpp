#include "fit/vertex_normals.hpp"

namespace sweepface {

namespace {

// Reflex corners look the other way than their face; of quads and triangles none counts as reflex.
Vec3 largeFaceNormal(const Polygons& polygons, std::span<const Vec3> positions, Index face) {
  Vec3 sum;
  const Index begin = polygons.faceStart[face], size = polygons.faceSize(face);
  const auto at = [&](Index k) { return positions[polygons.corners[begin + k]]; };
  if (size > 4)
    for (Index k = 1; k + 1 < size; ++k) sum += cross(at(k) - at(0), at(k + 1) - at(0));
  return sum;
}

}  // namespace

std::vector<Vec3> vertexNormals(const Polygons& polygons, std::span<const Vec3> positions,
                                const std::vector<Index>& pointOf, Index pointCount) {
  std::vector<Vec3> normals(pointCount);
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index begin = polygons.faceStart[f], size = polygons.faceSize(f);
    const Vec3 large = largeFaceNormal(polygons, positions, f);
    for (Index k = 0; k < size; ++k) {
      const Index v = polygons.corners[begin + k];
      const Vec3& p = positions[v];
      const Vec3 next = positions[polygons.corners[begin + (k + 1) % size]] - p;
      const Vec3 last = positions[polygons.corners[begin + (k + size - 1) % size]] - p;
      const Vec3 out = cross(next, last);
      if (pointOf[v] >= 0) normals[pointOf[v]] += dot(out, large) < 0 ? -1 * out : out;
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
