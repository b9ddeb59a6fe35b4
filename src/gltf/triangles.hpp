#pragma once

#include <array>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Three vertices of a run or corners of a polygon, counted from 0.
using Triangle = std::array<Index, 3>;

/// What a part is made of.
struct PartTriangles {
  /// Without degenerate ones that name a vertex twice, which strips use to turn corners.
  std::vector<Triangle> triangles;
  std::size_t named = 0;  ///< how many vertices its indices name
};

/// The triangles of a part, whether they are a list, a strip or a fan.
Result<PartTriangles> trianglesOf(const Document& document, const Parts& parts, const Part& part);

}  // namespace sweepface::gltf
