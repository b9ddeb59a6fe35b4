#pragma once

#include <array>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// Where a point lies among the source's vertices, to carry over what they have: skin weights,
/// colours, further texture coordinates.
struct Origin {
  std::array<Index, 4> vertices{};  ///< of the source; the first one again if there are fewer
  std::array<double, 4> shares{};   ///< those above 0 come first; they add up to 1
  friend bool operator==(const Origin&, const Origin&) = default;
};

/// The origins of all vertices of a tessellation of the rig [vertexCount], bilinear on the source's
/// quads. Fails if the rig does not know its source's vertices.
Result<std::vector<Origin>> originsOf(const Rig& rig, const Tessellation& grid);

}  // namespace sweepface
