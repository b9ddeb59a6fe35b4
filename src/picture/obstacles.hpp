#pragma once

#include <array>
#include <memory>
#include <span>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

/// Triangles that block rays. Whether one is hit does not depend on the number of threads.
class Obstacles {
 public:
  static Result<Obstacles> make(std::span<const Vec3> positions,
                                std::span<const std::array<Index, 3>> triangles);

  /// Whether something lies between `near` and `far` along a unit direction; lengths in model
  /// units.
  bool blocks(const Vec3& origin, const Vec3& direction, double near, double far) const;
  /// Length of the bounding box's diagonal, model units.
  double size() const { return size_; }

 private:
  struct Scene;
  struct Release {
    void operator()(Scene* scene) const;
  };
  Obstacles() = default;
  std::unique_ptr<Scene, Release> scene_;
  Vec3 centre_;
  double size_ = 1;
};

}  // namespace sweepface
