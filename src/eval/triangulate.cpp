// Ear clipping (Meisters 1975), seen along the polygon's mean normal.
#include "eval/triangulate.hpp"

#include <algorithm>

namespace sweepface {
namespace {

// Cutting takes time quadratic in the corners; larger polygons become fans.
constexpr std::size_t kMostCorners = 512;

class EarCutter {
 public:
  explicit EarCutter(std::span<const Vec3> polygon)
      : polygon_(polygon), normal_(meanNormal(polygon)), left_(polygon.size()) {
    for (std::size_t k = 0; k < left_.size(); ++k) left_[k].index = static_cast<Index>(k);
    for (std::size_t k = 0; k < left_.size(); ++k) weigh(k);
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    while (left_.size() > 3) {
      const auto ear = std::ranges::min_element(left_, {}, &Corner::cost);
      const auto k = static_cast<std::size_t>(ear - left_.begin());
      triangles.push_back(corner(k));
      left_.erase(ear);
      weigh(k + left_.size() - 1);
      weigh(k);
    }
    triangles.push_back(corner(1));
    return triangles;
  }

 private:
  /// A remaining corner, and the cost of cutting it off. Ears come before other corners, which are
  /// cut only if a twisted polygon has no ear; of each kind, the shortest cut comes first. Only the
  /// neighbours of a cut corner are weighed again.
  struct Corner {
    Index index;
    double cost;
  };

  void weigh(std::size_t k) {
    const Triangle t = corner(k);
    const double length = norm(polygon_[t[2]] - polygon_[t[0]]);
    left_[k % left_.size()].cost = isEar(t) ? -1 / length : length;
  }

  Triangle corner(std::size_t k) const {
    const std::size_t n = left_.size();
    return {left_[(k + n - 1) % n].index, left_[k % n].index, left_[(k + 1) % n].index};
  }

  /// Twice the area of a triangle along the mean normal, in no particular unit.
  double area(Index a, Index b, Index c) const {
    return dot(cross(polygon_[b] - polygon_[a], polygon_[c] - polygon_[a]), normal_);
  }

  bool isEar(const Triangle& t) const {
    if (!(area(t[0], t[1], t[2]) > 0)) return false;
    const auto isCorner = [&](Index p) {
      return std::ranges::any_of(t, [&](Index c) { return polygon_[c] == polygon_[p]; });
    };
    for (const auto& [p, cost] : left_) {
      if (isCorner(p)) continue;
      if (area(t[0], t[1], p) >= 0 && area(t[1], t[2], p) >= 0 && area(t[2], t[0], p) >= 0)
        return false;
    }
    return true;
  }

  std::span<const Vec3> polygon_;
  Vec3 normal_;
  std::vector<Corner> left_;
};

std::vector<Triangle> fan(Index corners) {
  std::vector<Triangle> triangles;
  for (Index k = 1; k + 1 < corners; ++k) triangles.push_back({0, k, k + 1});
  return triangles;
}

}  // namespace

std::vector<Vec3> cornerPositions(const Polygons& polygons, std::span<const Vec3> positions,
                                  Index face) {
  std::vector<Vec3> corners;
  for (Index c = polygons.faceStart[face]; c < polygons.faceStart[face + 1]; ++c)
    corners.push_back(positions[polygons.corners[c]]);
  return corners;
}

Vec3 meanNormal(std::span<const Vec3> polygon) {
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    sum += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return sum;
}

std::vector<Triangle> triangulate(std::span<const Vec3> polygon) {
  if (polygon.size() > 3 && polygon.size() <= kMostCorners) return EarCutter(polygon).cut();
  return fan(static_cast<Index>(polygon.size()));
}

}  // namespace sweepface
