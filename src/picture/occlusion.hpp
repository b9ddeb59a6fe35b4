#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

#include "picture/obstacles.hpp"

namespace sweepface {

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
