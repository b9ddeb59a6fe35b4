#include "fit/vertex_normals.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::vector<Vec3> normalsOf(const PolygonMesh& mesh) {
  return vertexNormals(mesh.polygons, mesh.positions, mesh.polygons.corners,
                       static_cast<Index>(mesh.positions.size()), {});
}

TEST(VertexNormals, LookOutOfAFlatPolygonAtItsReflexCornersToo) {
  PolygonMesh l;
  l.positions = {{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  addFace(l, {0, 1, 2, 3, 4, 5});
  for (const Vec3& normal : normalsOf(l)) EXPECT_EQ(normal, (Vec3{0, 0, 1}));
}

TEST(VertexNormals, OfLargeFacesAreThoseOfTheQuadsTheyAreCutInto) {
  PolygonMesh large, cut;
  large.positions = {{0, 0, 0}, {1, 0, 0.3}, {2, 0, 0}, {2, 2, 0.5}, {1, 2, 0}, {0, 2, 0.1}};
  cut.positions = large.positions;
  addFace(large, {0, 1, 2, 3, 4, 5});
  addFace(cut, {0, 1, 4, 5});
  addFace(cut, {1, 2, 3});
  addFace(cut, {1, 3, 4});
  const std::vector<Index> quads{0, 1, 4, 5, 1, 2, 3, 3, 1, 1, 3, 4};
  EXPECT_EQ(vertexNormals(large.polygons, large.positions, large.polygons.corners, 6, quads),
            normalsOf(cut));
}

TEST(VertexNormals, AreThoseOfCentralDifferencesOnAGrid) {
  const PolygonMesh mesh = plane(2, 2);
  const auto& p = mesh.positions;
  const Vec3 middle = normalsOf(mesh)[4], expected = normalized(cross(p[5] - p[3], p[7] - p[1]));
  EXPECT_NEAR(norm(middle - expected), 0, 1e-15);
}

}  // namespace
}  // namespace sweepface
