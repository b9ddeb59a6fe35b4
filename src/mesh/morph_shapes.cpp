#include "mesh/morph_shapes.hpp"

namespace sweepface {
namespace {

const Vec3 noNormal{0, 0, 1};  // of vertices without a surface

void appendAll(std::vector<Vec3>& list, const std::vector<Vec3>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

MorphShapes::MorphShapes(const Rig& rig, const Tessellation& grid) : rig_(rig), grid_(grid) {
  const std::vector<Vec3> vectors = blend(rig, {});
  neutral_ = {grid.positions(vectors), normals(vectors)};
  appendAll(neutral_.positions, rig.source.loose);
}

Index MorphShapes::placeOf(Index sourceVertex) const {
  const Index g = rig_.source.gridVertex[sourceVertex];
  return g >= 0 ? g : grid_.vertexCount() - 1 - g;
}

MorphShape MorphShapes::target(Index target, bool withNormals) const {
  if (target < 0)
    return {std::vector<Vec3>(neutral_.positions.size()),
            std::vector<Vec3>(withNormals ? neutral_.normals.size() : 0)};
  // Evaluation is linear, so the difference of the vectors gives that of the vertices, and zeros
  // stay zeros.
  const Target& t = rig_.targets[target];
  std::vector<Vec3> difference(rig_.surface.vectorCount());
  rig_.surface.settle(t.difference, difference);
  MorphShape result{grid_.positions(difference), {}};
  appendAll(result.positions, t.looseDifference);
  if (!withNormals) return result;

  result.normals = normals(blend(rig_, rig_.weightsOf(target + 1)));
  for (std::size_t v = 0; v < result.normals.size(); ++v) result.normals[v] -= neutral_.normals[v];
  return result;
}

std::vector<Vec3> MorphShapes::normals(std::span<const Vec3> vectors) const {
  std::vector<Vec3> list = grid_.normals(vectors);
  list.resize(list.size() + rig_.source.loose.size(), noNormal);
  for (Vec3& n : list)
    if (!isFinite(n) || n == Vec3{}) n = noNormal;
  return list;
}

}  // namespace sweepface
