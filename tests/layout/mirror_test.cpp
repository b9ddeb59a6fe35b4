#include "layout/mirror.hpp"

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

// Wider than high, so that it is mirrored across x alone.
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
  mesh.positions[30].z += 0.1;  // far beyond what places may differ by
  mesh.positions[31].z -= 0.1;
  EXPECT_TRUE(isWhole(mirrorOf(mesh)));
}

TEST(Mirror, OfAMeshWithAPartFarAwayIsSoughtAmongNeighbours) {
  // Within a thousandth of the diagonal of both lies all of the sheet.
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
    if (mesh.positions[v].x > 0) mesh.positions[v].z += 0.1;
  EXPECT_TRUE(isNowhere(mirrorOf(mesh)));
}

}  // namespace
}  // namespace sweepface
