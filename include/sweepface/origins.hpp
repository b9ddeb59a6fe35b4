#pragma once

#include <array>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// Where a point lies among the source's vertices, for what hangs on these: skin weights, colours,
/// further texture coordinates.
struct Origin {
  std::array<Index, 4> vertices{};  ///< of the source; the first one again where there are fewer
  std::array<double, 4> shares{};   ///< above 0 for those that count, first; they add up to 1
  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Of all vertices of a tessellation of the rig [vertexCount], bilinear on the source's quads.
/// Fails where the rig does not tell of its source's vertices.
Result<std::vector<Origin>> originsOf(const Rig& rig, const Tessellation& grid);

}  // namespace sweepface
