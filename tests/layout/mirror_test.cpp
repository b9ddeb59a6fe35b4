#include "layout/mirror.hpp"

#include <random>

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::vector<HalfEdge> mirrorOf(const PolygonMesh& neutral) {
  const MeshRig rig{neutral, {}};
  return findMirror(makeGridMesh(rig).value(), neutral.positions);
}

bool isWhole(const std::vector<HalfEdge>& mirror) {
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mirror.size()); ++h)
    if (mirror[h] < 0 || mirror[mirror[h]] != h) return false;
  return !mirror.empty();
}
bool isNowhere(const std::vector<HalfEdge>& mirror) {
  return std::ranges::all_of(mirror, [](HalfEdge h) { return h < 0; });
}

// Wider than high, so that it is symmetric across x alone.
PolygonMesh sheetAcross() {
  return grid(12, 5,
              [](double i, double j) { return Vec3{i - 6, j + i * (12 - i) / 9, j * j / 9}; });
}

TEST(Mirror, PairsEveryHalfEdgeOfASheetAndOfTwoThatMirrorEachOther) {
  EXPECT_TRUE(isWhole(mirrorOf(sheetAcross())));
  PolygonMesh right = grid(4, 5, [](double i, double j) { return Vec3{i, j, (j * j + i) / 9}; });
  PolygonMesh left = right;
  for (Vec3& p : left.positions) p.x = -p.x;
  for (Index f = 0; f < left.polygons.faceCount(); ++f)
    std::reverse(left.polygons.corners.begin() + left.polygons.faceStart[f],
                 left.polygons.corners.begin() + left.polygons.faceStart[f + 1]);
  EXPECT_TRUE(isWhole(mirrorOf(joined(right, left, {-1, 0, 0}))));
}

TEST(Mirror, ReachesOverVerticesThatAreNotWhereTheirImagesShouldBe) {
  PolygonMesh mesh = sheetAcross();
  mesh.positions[30].z += 0.1;  // far more than positions may differ by
  mesh.positions[31].z -= 0.1;
  EXPECT_TRUE(isWhole(mirrorOf(mesh)));
}

TEST(Mirror, OfAMeshWithAPartFarAwayIsSoughtAmongNeighbours) {
  // The whole sheet fits within a thousandth of the joint diagonal.
  PolygonMesh mesh = joined(sheetAcross(), sheetAcross(), {1e5, 0, 0});
  EXPECT_TRUE(isWhole(mirrorOf(mesh)));
}

TEST(Mirror, EndsWhereOneSideHasAQuadThatTheOtherHasNot) {
  PolygonMesh mesh = sheetAcross();
  Polygons& faces = mesh.polygons;
  faces.corners.erase(faces.corners.begin(), faces.corners.begin() + 4);
  faces.faceStart.pop_back();
  EXPECT_TRUE(isNowhere(mirrorOf(mesh)));
}

TEST(Mirror, IsNotSeenWhereFewPlacesAgree) {
  PolygonMesh mesh = sheetAcross();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (mesh.positions[v].x > 0) mesh.positions[v].z += 0.02;  // the diagonal is 15
  EXPECT_TRUE(isNowhere(mirrorOf(mesh)));
}

TEST(Mirror, IsSeenWhereEveryPlaceIsALittleOff) {
  PolygonMesh mesh = sheetAcross();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> off(-0.004, 0.004);
  for (Vec3& p : mesh.positions) p += Vec3{off(random), off(random), off(random)};
  EXPECT_TRUE(isWhole(mirrorOf(mesh)));
}

TEST(Mirror, StandsAcrossAnyAxisAndAnywhere) {
  PolygonMesh mesh = sheetAcross();
  for (int axis = 0; axis < 3; ++axis) {
    for (Vec3& p : mesh.positions) p = {p.z + 5, p.x - 7, p.y + 30};
    EXPECT_TRUE(isWhole(mirrorOf(mesh))) << axis;
  }
}

TEST(Mirror, StandsWhereMostPlacesAgree) {
  PolygonMesh mesh = grid(12, 6, [](double i, double j) { return Vec3{i - 6, j - 3, 0}; });
  for (Vec3& p : mesh.positions)
    if (p.y == 1 || p.x == 0) p.z = 0.5;
  const GridMesh quads = makeGridMesh({mesh, {}}).value();
  const std::vector<HalfEdge> mirror = findMirror(quads, mesh.positions);
  ASSERT_TRUE(isWhole(mirror));
  const auto place = [&](HalfEdge h) {
    return mesh.positions[quads.source[quads.point[quads.from(h)]]];
  };
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mirror.size()); ++h)
    EXPECT_EQ(place(h).x, -place(nextIn(mirror[h])).x);
}

TEST(Mirror, OfAPartIsLeftOutWhereFewOfItsPlacesAgree) {
  const PolygonMesh sheet = sheetAcross();
  PolygonMesh part = grid(6, 5, [](double i, double j) { return Vec3{i, j, i > 4 ? 1.5 : 1}; });
  const std::vector<HalfEdge> mirror = mirrorOf(joined(sheet, part, {-3, 1, 0.3}));
  EXPECT_EQ(std::ranges::count_if(mirror, [](HalfEdge h) { return h >= 0; }),
            4 * sheet.polygons.faceCount());
}

TEST(Mirror, DoesNotTakeATriangleForAQuad) {
  PolygonMesh mesh = sheetAcross();
  std::ranges::replace(mesh.polygons.corners, 0, 1);
  mesh.polygons.corners.erase(mesh.polygons.corners.begin());
  for (Index& start : mesh.polygons.faceStart) start -= start > 0;
  EXPECT_TRUE(isNowhere(mirrorOf(mesh)));
}

TEST(Mirror, IsLeftOutOfATorus) {
  EXPECT_TRUE(isWhole(mirrorOf(cubeSphere())));
  EXPECT_TRUE(isNowhere(mirrorOf(torus())));
}

TEST(Mirror, OfASmallPartIsNotThatOfTheMesh) {
  PolygonMesh mesh = joined(sheetAcross(), plane(20, 15), {-10, 20, 0});
  std::mt19937 random(2);
  for (std::size_t v = sheetAcross().positions.size(); v < mesh.positions.size(); ++v)
    mesh.positions[v].z += std::uniform_real_distribution<double>(0, 1)(random);
  EXPECT_TRUE(isNowhere(mirrorOf(mesh)));
}

}  // namespace
}  // namespace sweepface
