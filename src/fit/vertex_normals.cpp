#include "fit/vertex_normals.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "eval/triangulate.hpp"

namespace sweepface {

namespace {

/// Adds up the contributions of face corners.
class Normals {
 public:
  Normals(const Polygons& polygons, std::span<const Vec3> positions, std::span<const Index> pointOf,
          Index pointCount)
      : polygons_(polygons), positions_(positions), pointOf_(pointOf), sums_(pointCount) {}

  /// A loop of face corners, each of which may occur twice in a row.
  void add(std::span<const Index> loop, const Vec3& up = {}) {
    const std::size_t size = loop.size();
    for (std::size_t k = 0; k < size; ++k) {
      const Index here = loop[k];
      std::size_t next = (k + 1) % size, last = (k + size - 1) % size;
      if (loop[next] == here) continue;
      if (loop[last] == here) last = (last + size - 1) % size;
      const Vec3 out = cross(at(loop[next]) - at(here), at(loop[last]) - at(here));
      if (const Index point = pointOf_[here]; point >= 0)
        sums_[point] += dot(out, up) < 0 ? -1 * out : out;
    }
  }

  std::vector<Vec3> take() {
    for (Vec3& sum : sums_) sum = normalized(sum);
    return std::move(sums_);
  }

 private:
  const Vec3& at(Index corner) const { return positions_[polygons_.corners[corner]]; }

  const Polygons& polygons_;
  std::span<const Vec3> positions_;
  std::span<const Index> pointOf_;
  std::vector<Vec3> sums_;
};

}  // namespace

std::vector<Vec3> vertexNormals(const Polygons& polygons, std::span<const Vec3> positions,
                                std::span<const Index> pointOf, Index pointCount,
                                std::span<const Index> quadCorners) {
  Normals normals(polygons, positions, pointOf, pointCount);
  std::vector<char> isOfLarge(polygons.corners.size(), 0);
  std::vector<Index> loop;
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index begin = polygons.faceStart[f], size = polygons.faceSize(f);
    if (size > 4) std::fill_n(isOfLarge.begin() + begin, size, 1);
    if (size > 4 && !quadCorners.empty()) continue;
    loop.resize(size);
    std::iota(loop.begin(), loop.end(), begin);
    // The products at reflex corners point the other way; in quads and triangles that is ignored.
    normals.add(loop, size > 4 ? meanNormal(cornerPositions(polygons, positions, f)) : Vec3{});
  }
  for (std::size_t k = 0; k < quadCorners.size(); k += 4)
    if (isOfLarge[quadCorners[k]]) normals.add(quadCorners.subspan(k, 4));
  return normals.take();
}

std::vector<double> normalAngles(std::span<const Vec3> source, std::span<const Vec3> surface) {
  std::vector<double> angles;
  for (std::size_t v = 0; v < source.size(); ++v)
    if (norm(source[v]) != 0) angles.push_back(angleDegrees(surface[v], source[v]));
  return angles;
}

}  // namespace sweepface
