// Where there is no Embree: the same by the tree of boxes that Eigen has.
#include "sweepface/box.hpp"

#include "picture/obstacles.hpp"
#include "picture/triangle_tree.hpp"

namespace sweepface {

struct Obstacles::Scene {
  TriangleTree tree;
};
void Obstacles::Release::operator()(Scene* scene) const { delete scene; }

Result<Obstacles> Obstacles::make(std::span<const Vec3> positions,
                                  std::span<const std::array<Index, 3>> triangles) {
  Obstacles o;
  const Box box(positions);
  if (const double size = norm(box.size()); size > 0) o.size_ = size;
  o.scene_.reset(new Scene{TriangleTree(positions, triangles)});
  return o;
}

bool Obstacles::blocks(const Vec3& origin, const Vec3& direction, double near, double far) const {
  return scene_->tree.blocks(origin, direction, near, far);
}

}  // namespace sweepface
