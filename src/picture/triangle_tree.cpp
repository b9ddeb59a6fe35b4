#include "picture/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace sweepface {
namespace {

using BoxTree = Eigen::KdBVH<double, 3, int>;

/// A corner and the edges from it to the others.
struct Triangle {
  Vec3 corner, first, second;
};

/// What lies on a ray; BVIntersect() asks it about boxes and what is in them.
struct Ray {
  const std::vector<Triangle>& triangles;
  Vec3 origin, direction;
  double near, far;
  bool isBlocked = false;

  bool intersectVolume(const BoxTree::Volume& box) const {
    double from = near, to = far;
    for (int k = 0; k < 3; ++k) {
      const double start = coordinate(origin, k), speed = coordinate(direction, k);
      const double a = (box.min()[k] - start) / speed, b = (box.max()[k] - start) / speed;
      // A ray within the plane of a side gives 0 / 0, which no comparison is true of.
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return from <= to;
  }

  /// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997).
  bool intersectObject(int t) {
    const auto& [corner, first, second] = triangles[static_cast<std::size_t>(t)];
    const Vec3 across = cross(direction, second);
    const double volume = dot(first, across);
    if (volume == 0) return false;  // seen from its edge
    const Vec3 away = origin - corner;
    const double u = dot(away, across) / volume;
    if (!(u >= 0 && u <= 1)) return false;
    const Vec3 other = cross(away, first);
    const double v = dot(direction, other) / volume;
    if (!(v >= 0 && u + v <= 1)) return false;
    const double distance = dot(second, other) / volume;
    isBlocked = distance >= near && distance <= far;
    return isBlocked;
  }
};

}  // namespace

struct TriangleTree::Boxes {
  std::vector<Triangle> triangles;
  BoxTree tree;
};

TriangleTree::TriangleTree(std::span<const Vec3> positions,
                           std::span<const std::array<Index, 3>> triangles)
    : boxes_(std::make_unique<Boxes>()) {
  std::vector<BoxTree::Volume, Eigen::aligned_allocator<BoxTree::Volume>> boxes;
  std::vector<int> numbers;
  for (const auto& [a, b, c] : triangles) {
    BoxTree::Volume box;
    for (const Index v : {a, b, c})
      box.extend(Eigen::Vector3d(positions[v].x, positions[v].y, positions[v].z));
    const Vec3& corner = positions[a];
    boxes_->triangles.push_back({corner, positions[b] - corner, positions[c] - corner});
    numbers.push_back(static_cast<int>(boxes.size()));
    boxes.push_back(box);
  }
  boxes_->tree.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

TriangleTree::~TriangleTree() = default;

bool TriangleTree::blocks(const Vec3& origin, const Vec3& direction, double near,
                          double far) const {
  if (boxes_->triangles.empty()) return false;
  Ray ray{boxes_->triangles, origin, direction, near, far};
  Eigen::BVIntersect(boxes_->tree, ray);
  return ray.isBlocked;
}

}  // namespace sweepface
