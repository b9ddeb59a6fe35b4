#pragma once

#include <array>
#include <memory>
#include <span>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Triangles in a tree of boxes.
class TriangleTree {
 public:
  TriangleTree(std::span<const Vec3> positions, std::span<const std::array<Index, 3>> triangles);
  ~TriangleTree();

  /// Whether a triangle lies between `near` and `far` along a unit direction.
  bool blocks(const Vec3& origin, const Vec3& direction, double near, double far) const;

 private:
  struct Boxes;
  std::unique_ptr<Boxes> boxes_;
};

}  // namespace sweepface
