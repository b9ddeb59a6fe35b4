#include "fit/facets.hpp"

#include "sweepface/fit.hpp"

#include "faces.hpp"
#include "fit/corner_places.hpp"
#include "fit/vertex_normals.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class EveryFacet : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Facets, EveryFacet, eachFace(), faceName);

std::vector<Index> placesOf(const Rig& rig) {
  return cornerPlaces(rig.source, Tessellation(rig.surface, 1));
}

bool shareAVertex(const Loop& a, const Loop& b) {
  return std::ranges::find_first_of(a, b) != a.end();
}

TEST_P(EveryFacet, isNoFurtherThanThoseThatShareAVertexWithIt) {
  ConvertOptions options;
  options.tolerance = 0.01 * diagonal(GetParam().rig.neutral);
  const Rig rig = convert(GetParam().rig, options).value().rig;
  const std::vector<Vec3>& positions = GetParam().rig.neutral.positions;
  const FaceMap map(rig, placesOf(rig), positions);
  FaceMap apart = map;  // no face has neighbours
  for (std::vector<Index>& faces : apart.facesAt) faces.clear();
  const Facets facets(rig.source, map, positions, {}, 0),
      alone(rig.source, apart, positions, {}, 0);
  const std::vector<Loop> loops = loopsOf(rig.source.polygons);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const Vec3 p = positions[(7 * f) % positions.size()] + Vec3{0.1, 0.2, 0.3};
    double nearest = 1e300;
    for (std::size_t g = 0; g < loops.size(); ++g)
      if (shareAVertex(loops[f], loops[g]))
        nearest = std::min(nearest, alone.distance(p, static_cast<Index>(g)));
    EXPECT_EQ(facets.distance(p, static_cast<Index>(f)), nearest) << "face " << f;
  }
}

TEST(Facets, OfAConcavePolygonDoNotCoverItsNotch) {
  PolygonMesh l;
  l.positions = {{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  addFace(l, {0, 1, 2, 3, 4, 5});
  const Rig rig = convert({l, {}}).value().rig;
  const FaceMap map(rig, placesOf(rig), l.positions);
  const Facets facets(rig.source, map, l.positions, {}, 0);
  EXPECT_NEAR(facets.distance({1.3, 1.3, 0}, 0), 0.3, 1e-12);
  EXPECT_NEAR(facets.distance({0.7, 0.7, 0.1}, 0), 0.1, 1e-12);
}

TEST(Facets, SagByAnEighthOfTheirEdgesTimesTheAngleBetweenTheirNormals) {
  constexpr Index n = 24;
  const MeshRig tube{grid(
                         n, 3,
                         [](double i, double j) {
                           const double a = turn(i / n);
                           return Vec3{4 * std::cos(a), 4 * std::sin(a), j};
                         },
                         true),
                     {}};
  const std::vector<Vec3>& positions = tube.neutral.positions;
  const Rig rig = convert(tube).value().rig;
  const FaceMap map(rig, placesOf(rig), positions);
  const std::vector<Vec3> normals =
      vertexNormals(rig.source.polygons, positions, map.cornerPlaces,
                    Tessellation(rig.surface, 1).vertexCount(), rig.source.quadCorners);
  const Facets facets(rig.source, map, positions, normals, 0);
  const double edge = norm(positions[1] - positions[0]), expected = edge * turn(1.0 / n) / 8;
  for (Index face = n; face < 2 * n; ++face)
    EXPECT_NEAR(facets.sag(face), expected, 0.01 * expected) << face;
}

TEST(FaceMap, OfAFanTakesRoomForItsCornersAlone) {
  constexpr Index kTriangles = 1000;
  PolygonMesh fan;
  for (Index k = 1; k <= kTriangles; ++k) addFace(fan, {0, k, k + 1});
  Rig rig;
  rig.source.polygons = fan.polygons;
  rig.source.gridVertex.resize(kTriangles + 2);
  std::size_t entries = 0;
  const FaceMap map(rig, fan.polygons.corners, std::vector<Vec3>(kTriangles + 2));
  for (const std::vector<Index>& faces : map.facesAt) entries += faces.size();
  EXPECT_EQ(entries, fan.polygons.corners.size());
}

}  // namespace
}  // namespace sweepface
