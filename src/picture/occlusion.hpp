#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

struct RTCDeviceTy;
struct RTCSceneTy;

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
  struct Release {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
  };
  Obstacles() = default;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  Vec3 centre_;
  double size_ = 1;
};

/// Whether long work was asked to end.
inline bool isCancelled(const std::atomic<bool>* cancel) { return cancel && *cancel; }

/// The share of the sky's light that reaches each vertex [V], from fixed directions all over it.
/// Worthless if it was cancelled.
std::vector<float> skyExposure(const Obstacles& obstacles, std::span<const Vec3> positions,
                               std::span<const Vec3> normals, const std::atomic<bool>* cancel);

/// The same for a lamp with an angular radius of `radius` around a unit direction. The part of the
/// lamp below a vertex's own horizon counts like the sky there.
std::vector<float> lampExposure(const Obstacles& obstacles, std::span<const Vec3> positions,
                                std::span<const Vec3> normals, const Vec3& towards, double radius,
                                std::span<const float> sky, const std::atomic<bool>* cancel);

}  // namespace sweepface
