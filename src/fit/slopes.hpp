#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// The errors of the two tangents at each vertex, relative to their lengths.
struct Slopes {
  struct Tangent {
    std::array<float, 3> error{};   ///< the neutral's included
    float lean = 0;                 ///< along the normal, the neutral's excluded: in radians
    std::array<float, 3> normal{};  ///< of the surface
    float perLength = 0;
  };
  std::vector<std::array<Tangent, 2>> at;  ///< [vertices]
  float weight = 0;                        ///< cost of a squared lean, in bits
};

/// The settled vectors of a pose as it was fitted, and their errors: the pose's own, and with those
/// of the neutral that it is added to. [vectorCount] each.
struct SlopeVectors {
  std::span<const Vec3> form, off, whole;
};

/// For the vertices of level 1 that are `known`, except poles and others whose tangents span no
/// plane. Tangents shorter than `shortest` have no direction to keep and count as that long.
Slopes slopesOf(const Surface& surface, const Tessellation& level1, std::span<const char> known,
                const SlopeVectors& vectors, double shortest, float weight);

}  // namespace sweepface
