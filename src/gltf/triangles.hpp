#pragma once

#include <vector>

#include "eval/triangulate.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// What a part is made of.
struct PartTriangles {
  /// Without degenerate ones that name a vertex twice, which strips use to turn corners.
  std::vector<Triangle> triangles;
  std::size_t named = 0;  ///< how many vertices its indices name
};

/// The triangles of a part, whether they are a list, a strip or a fan.
Result<PartTriangles> trianglesOf(const Document& document, const Parts& parts, const Part& part);

}  // namespace sweepface::gltf
