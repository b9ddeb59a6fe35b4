#include "mesh/grid_source.hpp"

#include <numeric>

#include "sweepface/eval.hpp"

namespace sweepface {

namespace {

int distinctCorners(const std::array<Index, 4>& quad) {
  int count = 0;
  for (int k = 0; k < 4; ++k) count += quad[k] != quad[(k + 1) % 4];
  return count;
}

// Corners that are one vertex become one corner of the face.
void addQuad(SourceMesh& source, const std::array<Index, 4>& quad) {
  Polygons& faces = source.polygons;
  const bool triangle = distinctCorners(quad) == 3;
  std::array<Index, 4> corner{};
  const auto first = static_cast<Index>(faces.corners.size());
  for (int k = 0; k < 4; ++k) {
    const bool again = triangle && k > 0 && quad[k] == quad[k - 1];
    const bool closes = triangle && k == 3 && quad[3] == quad[0];
    if (!again && !closes) faces.corners.push_back(quad[k]);
    corner[k] = closes ? first : static_cast<Index>(faces.corners.size()) - 1;
  }
  source.quadCorners.insert(source.quadCorners.end(), corner.begin(), corner.end());
  faces.faceStart.push_back(static_cast<Index>(faces.corners.size()));
}

}  // namespace

SourceMesh gridSource(const Surface& surface) {
  const Tessellation grid(surface, 1);
  SourceMesh source;
  source.gridVertex.resize(grid.vertexCount());
  std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
  for (const auto& quad : grid.faces()) addQuad(source, quad);
  return source;
}

}  // namespace sweepface
