#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// How far off the two tangents at each vertex are, as shares of their lengths.
struct Slopes {
  struct Tangent {
    std::array<float, 3> error{};   ///< the neutral's included
    float lean = 0;                 ///< along the normal: an angle in radians
    std::array<float, 3> normal{};  ///< of the surface
    float perLength = 0;
  };
  std::vector<std::array<Tangent, 2>> at;  ///< [vertices]
  float weight = 0;                        ///< what the square of a lean counts, in bits
};

/// A settled pose as it is fitted, and how far off it is told: by itself, and with the neutral that
/// it is added to. [vectorCount] each.
struct SlopeVectors {
  std::span<const Vec3> form, off, whole;
};

/// Of the vertices of level 1 that are `known`, but for poles and for what has no side. What is
/// shorter than `shortest` has no direction to keep.
Slopes slopesOf(const Surface& surface, const Tessellation& level1, std::span<const char> known,
                const SlopeVectors& vectors, double shortest, float weight);

}  // namespace sweepface
