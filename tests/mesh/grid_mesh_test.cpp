#include "mesh/grid_mesh.hpp"

#include <map>
#include <numeric>

#include "faces.hpp"
#include "mesh/weld.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

GridMesh gridOf(const MeshRig& rig) { return makeGridMesh(rig).value(); }
GridMesh gridOf(PolygonMesh mesh) { return gridOf(MeshRig{std::move(mesh), {}}); }

Index openSides(const GridMesh& mesh) {
  Index count = 0;
  for (std::size_t h = 0; h < mesh.twin.size(); ++h)
    count += mesh.twin[h] < 0 && !mesh.collapsed[h];
  return count;
}

class EveryFace : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(GridMesh, EveryFace, eachFace(), faceName);

TEST_P(EveryFace, becomesQuadsBetweenTheSourceVerticesAtTheirCorners) {
  const MeshRig& rig = GetParam().rig;
  const GridMesh mesh = gridOf(rig);
  const std::vector<Index> first = weldedVertices(rig);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k) {
      const Index source = rig.neutral.polygons.corners[mesh.quadCorners[q][k]];
      EXPECT_EQ(mesh.pointOfSource[source], mesh.point[mesh.quads[q][k]]);
      EXPECT_EQ(first[mesh.source[mesh.point[mesh.quads[q][k]]]], first[source]);
    }
}

TEST_P(EveryFace, pairsHalfEdgesWithTheirTwins) {
  const GridMesh mesh = gridOf(GetParam().rig);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h) {
    if (mesh.twin[h] < 0) continue;
    EXPECT_EQ(mesh.twin[mesh.twin[h]], h);
    EXPECT_EQ(mesh.from(h), mesh.to(mesh.twin[h]));
  }
}

TEST_P(EveryFace, keepsItsShape) {
  const GridMesh mesh = gridOf(GetParam().rig);
  std::vector<Loop> quads;
  for (const auto& quad : mesh.quads) {
    Loop loop;
    for (Index v : quad) loop.push_back(mesh.point[v]);
    quads.push_back(loop);
  }
  EXPECT_EQ(topologyOf(quads), topologyOf(weldedLoops(GetParam().rig)));
  EXPECT_TRUE(mesh.warnings.empty());
}

TEST(Welding, joinsVerticesThatStandTogetherInEveryPose) {
  const MeshRig seam = withTargets(cylinder(12, 4, true));
  EXPECT_EQ(gridOf(seam).pointCount(), 12 * 5);
  EXPECT_EQ(openSides(gridOf(seam)), 2 * 12);
}

TEST(Welding, leavesVerticesApartThatOneTargetParts) {
  MeshRig seam = withTargets(cylinder(12, 4, true));
  for (std::size_t v = 0; v < seam.neutral.positions.size(); v += 13)
    seam.targets[1].positions[v].x += 1;
  EXPECT_EQ(gridOf(seam).pointCount(), 13 * 5);
  EXPECT_EQ(openSides(gridOf(seam)), 2 * 12 + 2 * 4);
}

/// Copies of a vertex that rounding parts in one pose would leave a slit in every pose.
TEST(Welding, joinsWhatRoundingParted) {
  MeshRig seam = withTargets(cylinder(12, 4, true));
  for (std::size_t v = 0; v < seam.neutral.positions.size(); v += 13)
    seam.targets[1].positions[v].x += 3e-6;
  EXPECT_EQ(gridOf(seam).pointCount(), 13 * 5) << "not unless asked";
  const GridMesh joined = makeGridMesh(seam, 1e-5).value();
  EXPECT_EQ(joined.pointCount(), 12 * 5);
  EXPECT_NEAR(joined.rounding, 3e-6, 1e-12);
  EXPECT_EQ(makeGridMesh(seam, 1e-6)->pointCount(), 13 * 5) << "further than asked";
  for (std::size_t v = 0; v < seam.neutral.positions.size(); v += 13)
    seam.targets[1].positions[v].x += 0.01;
  EXPECT_EQ(makeGridMesh(seam, 0.1)->pointCount(), 13 * 5) << "too far for its edges";
}

/// Meshes that were mirrored but not merged, or merged and then moved.
TEST(Welding, tellsOfSeamsThatStayOpen) {
  MeshRig seam = withTargets(cylinder(12, 4, true));
  const auto move = [&](double way) {
    for (std::size_t v = 0; v < seam.neutral.positions.size(); v += 13)
      seam.targets[1].positions[v].x += way;
  };
  move(0.001);
  const GridMesh mesh = makeGridMesh(seam, 1e-6, 0.002).value();
  EXPECT_EQ(mesh.pointCount(), 13 * 5) << "they stay open";
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(mesh.warnings[0],
            "The surface is open along 5 vertices within 0.001 of others in every expression, like "
            "12 and 0 (counted from 0); merge them if it is meant to be closed there.");
  EXPECT_EQ(makeGridMesh(seam, 1e-6, 0.0009)->warnings.at(0),
            "The surface is open, in all expressions, along 5 vertices that stand where others do "
            "in the neutral, but up to 0.001 from them in an expression, like 12 and 0 (counted "
            "from 0) in 'target2'; move them alike there if it is meant to be closed.");
  EXPECT_TRUE(makeGridMesh(seam, 1e-6, 0.00009)->warnings.empty()) << "further apart";
  EXPECT_TRUE(makeGridMesh(seam, 0.002, 0.002)->warnings.empty()) << "joined";
  move(0.1);
  EXPECT_TRUE(makeGridMesh(seam, 1e-6, 1)->warnings.empty()) << "too far for its edges";
}

/// Cards of hair and lashes, narrower than the gap that is looked for.
TEST(Welding, leavesNarrowCardsAsTheyAre) {
  const auto withCards = [](Index columns, Index rows) {
    PolygonMesh cards = grid(8, 8, [](double x, double y) { return Vec3{x, y, 0}; });
    const auto card = [&](double x, double y) { return Vec3{0.001 * x / columns, y, 1}; };
    for (int k = 0; k < 5; ++k) cards = joined(cards, grid(columns, rows, card), {1.0 * k, 0, 0});
    return MeshRig{cards, {}};
  };
  for (const auto& [columns, rows] : {std::pair(1, 1), {2, 1}, {2, 4}})
    EXPECT_TRUE(makeGridMesh(withCards(columns, rows), 1e-6, 0.002)->warnings.empty()) << columns;
  EXPECT_EQ(makeGridMesh(withCards(1, 1), 0.002, 0.002)->pointCount(), 81 + 5 * 4);
}

/// Gaps count by how wide they are, not by how far their vertices reach together.
TEST(Welding, tellsHowFarSeamsAreOpenNotHowLongTheyAre) {
  const auto sheetAt = [](double x) {
    return grid(1, 8, [x](double i, double j) { return Vec3{x + i, j, 0}; });
  };
  PolygonMesh sheets = sheetAt(0);
  sheets = joined(sheets, sheetAt(0), {1.001, 0, 0});
  sheets = joined(sheets, sheetAt(0), {2.0025, 0, 0});
  const auto warnings = makeGridMesh({sheets, {}}, 1e-6, 0.002)->warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("along 18 vertices within 0.0015 of others"), std::string::npos)
      << warnings[0];
}

/// Two sheets of 40 × 40 quads that meet along an edge where each has its own vertices.
TEST(Welding, joinsWhatRoundingPartedHoweverItStands) {
  PolygonMesh sheets =
      joined(grid(40, 40, [](double x, double y) { return Vec3{x, y, 0}; }),
             grid(40, 40, [](double x, double y) { return Vec3{x, y, 0}; }), {40, 0, 0});
  for (std::size_t v = 0; v < sheets.positions.size(); ++v)
    sheets.positions[v].z += 1e-7 * static_cast<double>(v % 3);
  std::mt19937 random(11);
  for (int round = 0; round < 10; ++round) {
    PolygonMesh turned = sheets;
    const Vec3 axis = normalized({std::uniform_real_distribution(-1.0, 1.0)(random), 0.5, 0.3});
    const Vec3 side = normalized(cross(axis, {0, 0, 1})), up = cross(axis, side);
    for (Vec3& p : turned.positions) p = p.x * axis + p.y * side + p.z * up;
    const Index points = makeGridMesh({turned, {}}, 1e-6)->pointCount();
    EXPECT_EQ(points, 81 * 41) << round;
  }
}

/// Like the pages of a book, one of them upside down.
TEST(Welding, leavesThreeSheetsApartThatRoundingPartedAlongAnEdge) {
  PolygonMesh book;
  for (int page = 0; page < 3; ++page) {
    const double angle = turn(page / 3.0), off = 1e-7 * page;
    const auto place = [&](double i, double j) {
      const double r = page == 0 ? 4 - i : i;
      return Vec3{r * std::cos(angle), r * std::sin(angle), j + off};
    };
    book = joined(book, grid(4, 4, place), {});
  }
  EXPECT_EQ(makeGridMesh({book, {}}, 1e-6)->pointCount(), 3 * 25);
}

/// In floating point the sine of pi is not quite 0, so a sphere's last row is a tiny ring.
TEST(Welding, closesPolesThatRoundingOpened) {
  const auto cone = [](double tip) {
    return grid(12, 4, [tip](double x, double y) {
      const double turn = 2 * std::numbers::pi * std::fmod(x, 12) / 12;
      const double radius = y < 4 ? 5 - y : tip;
      return Vec3{radius * std::cos(turn), radius * std::sin(turn), y};
    });
  };
  for (double tip : {0.0, 1e-16, 1e-7}) {
    const GridMesh mesh = makeGridMesh({cone(tip), {}}, 1e-6).value();
    EXPECT_EQ(mesh.pointCount(), 12 * 4 + 1) << tip;
    EXPECT_EQ(openSides(mesh), 12) << tip;
  }
  for (double hole : {1e-3, 1e-6})  // the latter's edges are shorter than the rounding
    EXPECT_EQ(openSides(makeGridMesh({cone(hole), {}}, 1e-6).value()), 2 * 12) << hole;
}

/// Next to a large ground plane, the rounding is as large as a detail.
TEST(Welding, leavesDetailsThatAreMereRounding) {
  const auto flat = [](double size) {
    return [size](double x, double y) { return Vec3{size * x, size * y, 0}; };
  };
  for (Index n : {1, 3}) {
    const PolygonMesh both =
        joined(grid(1, 1, flat(1000)), grid(n, n, flat(5e-4 / n)), {2000, 0, 0});
    EXPECT_EQ(makeGridMesh({both, {}}, 1e-3)->pointCount(), 4 + (n + 1) * (n + 1)) << n;
  }
}

/// Sides that only a weld joins are not open, however short they are.
TEST(Welding, leavesShortEdgesWithinASoup) {
  PolygonMesh mesh;
  const Loop around{0, 1, 2, 3};
  for (const auto& [x, width] : {std::pair(0.0, 1.0), {1.0, 1e-7}, {1 + 1e-7, 1.0}}) {
    Loop face;
    for (const auto& [dx, y] : {std::pair(0.0, 0.0), {width, 0.0}, {width, 1.0}, {0.0, 1.0}}) {
      face.push_back(static_cast<Index>(mesh.positions.size()));
      mesh.positions.push_back({x + dx, y, 0});
    }
    addFace(mesh, face);
    for (double y : {-1.0, 1.0}) {  // and the faces that close the short edges
      face.clear();
      for (const auto& [dx, dy] : {std::pair(0.0, 0.0), {width, 0.0}, {width, 1.0}, {0.0, 1.0}}) {
        face.push_back(static_cast<Index>(mesh.positions.size()));
        mesh.positions.push_back({x + dx, y + dy, 0});
      }
      addFace(mesh, face);
    }
  }
  EXPECT_EQ(makeGridMesh({mesh, {}})->pointCount(), 16);
  EXPECT_EQ(openSides(makeGridMesh({mesh, {}}, 1e-6).value()),
            openSides(makeGridMesh({mesh, {}}).value()) - 2);
}

/// Lashes touch lids only at vertices, and vertices that no face uses join nothing.
TEST(Welding, leavesApartWhatTouchesAlongNoEdge) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0},        {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                    {1 + 1e-9, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  addFace(mesh, {0, 1, 2, 3});
  addFace(mesh, {4, 5, 6, 7});
  EXPECT_EQ(makeGridMesh({mesh, {}}, 1e-6)->pointCount(), 8);
  mesh.positions = {{0, 0, 0},        {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                    {1 + 4e-6, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1 + 4e-6, 1, 0}};
  for (const double y : {0, 1})
    for (int k = 0; k <= 5; ++k) mesh.positions.push_back({1 + 0.8e-6 * k, y, 0});
  EXPECT_EQ(makeGridMesh({mesh, {}}, 1e-6)->pointCount(), 8);
}

TEST(Welding, takesBothZerosForTheSame) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-0.0, 0, 0}, {-1, 1, 0}};
  addFace(mesh, {0, 1, 2, 3});
  addFace(mesh, {4, 3, 5});
  EXPECT_EQ(openSides(gridOf(mesh)), 5);
}

// Lids and whatever lies on them: corners coincide but face different ways.
TEST(Welding, leavesSheetsThatTouchAtAVertexAPointEach) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0},   {1, 1, 0},  {0, 1, 0},
                    {0, 0, 0}, {-1, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
  addFace(mesh, {0, 1, 2, 3});
  addFace(mesh, {4, 5, 6, 7});
  const GridMesh quads = gridOf(mesh);
  EXPECT_EQ(quads.pointCount(), 8);
  for (std::size_t q = 0; q < 2; ++q)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(quads.pointOfSource[mesh.polygons.corners[quads.quadCorners[q][k]]],
                quads.point[quads.quads[q][k]]);
}

TEST(Cutting, turnsAPolygonIntoQuadsAndAtMostOneTriangle) {
  for (Index corners = 3; corners <= 12; ++corners) {
    PolygonMesh mesh;
    Loop face;
    for (Index k = 0; k < corners; ++k) {
      face.push_back(k);
      mesh.positions.push_back(
          {std::cos(turn(1.0 * k / corners)), std::sin(turn(1.0 * k / corners)), 0});
    }
    addFace(mesh, face);
    const GridMesh result = gridOf(mesh);
    EXPECT_EQ(static_cast<Index>(result.quads.size()), (corners - 1) / 2);
    EXPECT_EQ(std::ranges::count(result.collapsed, 1), corners % 2);
    EXPECT_EQ(openSides(result), corners);
  }
}

const std::vector<Vec3> kL{{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}};
const std::vector<Vec3> kU{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0},
                           {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};

/// Twice the area of the pieces of a planar mesh, or 0 if one of them is not convex.
double areaOfPieces(const PolygonMesh& mesh) {
  const GridMesh result = gridOf(mesh);
  double sum = 0;
  for (const auto& quad : result.quads) {
    const auto at = [&](std::size_t k) {
      return mesh.positions[result.source[result.point[quad[k % 4]]]];
    };
    for (std::size_t k = 0; k < 4; ++k)
      if (cross(at(k + 1) - at(k), at(k + 2) - at(k)).z < 0) return 0;
    sum += cross(at(2) - at(0), at(3) - at(1)).z;
  }
  return sum;
}

TEST(Cutting, keepsToTheInsideOfConcavePolygons) {
  for (const auto& [corners, area] : {std::pair{kL, 3}, {kU, 7}})
    for (std::size_t first = 0; first < corners.size(); ++first) {
      PolygonMesh mesh;
      mesh.positions = corners;
      std::ranges::rotate(mesh.positions, mesh.positions.begin() + static_cast<Index>(first));
      Loop face;
      for (Index k = 0; k < static_cast<Index>(corners.size()); ++k) face.push_back(k);
      addFace(mesh, face);
      EXPECT_EQ(areaOfPieces(mesh), 2 * area) << "from corner " << first;
    }
}

TEST(Cutting, makesQuadsOfAConcavePolygonWhereACornerSeesThemAll) {
  PolygonMesh mesh;
  mesh.positions = kL;
  addFace(mesh, {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(gridOf(mesh).quads.size(), 2u);
}

/// The smallest sine of any corner angle among the pieces of one polygon.
double leastSine(const std::vector<Vec3>& corners) {
  PolygonMesh mesh;
  mesh.positions = corners;
  Loop face(corners.size());
  std::iota(face.begin(), face.end(), 0);
  addFace(mesh, face);
  double least = 1;
  for (const auto& quad : gridOf(mesh).quadCorners) {
    Loop piece(quad.begin(), quad.end());
    piece.erase(std::unique(piece.begin(), piece.end()), piece.end());
    const auto at = [&](std::size_t k) { return mesh.positions[piece[k % piece.size()]]; };
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const Vec3 next = at(k + 2) - at(k + 1), last = at(k) - at(k + 1);
      least = std::min(least, norm(cross(next, last)) / norm(next) / norm(last));
    }
  }
  return least;
}

TEST(Cutting, leavesNoCornerInLine) {
  EXPECT_GT(leastSine({{0, 0, 0}, {1, 1e-4, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}}), 0.25);
  std::vector<Vec3> pentagon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  for (int first = 0; first < 5; ++first) {
    EXPECT_GT(leastSine(pentagon), 0.4) << first;
    std::ranges::rotate(pentagon, pentagon.begin() + 1);
  }
  // The outline of 3 × 3 quads.
  EXPECT_GT(leastSine({{0, 0, 0},
                       {1, 0, 0},
                       {2, 0, 0},
                       {3, 0, 0},
                       {3, 1, 0},
                       {3, 2, 0},
                       {3, 3, 0},
                       {2, 3, 0},
                       {1, 3, 0},
                       {0, 3, 0},
                       {0, 2, 0},
                       {0, 1, 0}}),
            0.1);
}

TEST(Cutting, makesALadderOfAStripWhereverItBegins) {
  constexpr Index kEnd = 100;
  std::vector<Vec3> strip;
  for (Index x = 0; x <= kEnd; ++x) strip.push_back({1.0 * x, 0, 0});
  for (Index x = kEnd; x >= 0; --x) strip.push_back({1.0 * x, 1, 0});
  for (const Index first : {0, 50, 150}) {
    std::ranges::rotate(strip, strip.begin() + first);
    EXPECT_GT(leastSine(strip), 0.9) << first;
  }
}

TEST(Cutting, makesLaddersOfCaps) {
  PolygonMesh mesh;
  Loop face;
  for (Index k = 0; k < 40; ++k) {
    face.push_back(k);
    mesh.positions.push_back({std::cos(turn(k / 40.0)), std::sin(turn(k / 40.0)), 0});
  }
  addFace(mesh, face);
  std::map<Index, int> uses;
  for (const auto& quad : gridOf(mesh).quadCorners)
    for (const Index corner : quad) ++uses[corner];
  for (const auto& [corner, count] : uses) EXPECT_LE(count, 2) << corner;
}

TEST(Cutting, refusesFacesOfThousandsOfCorners) {
  PolygonMesh mesh = plane(3, 3);
  Loop face;
  for (Index k = 0; k < 4097; ++k) {
    face.push_back(static_cast<Index>(mesh.positions.size()));
    mesh.positions.push_back({std::cos(turn(k / 4097.0)), std::sin(turn(k / 4097.0)), 0});
  }
  addFace(mesh, face);
  const auto none = makeGridMesh({mesh, {}});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message,
            "face 10 has 4097 corners, of which 4096 are the most; cut it into smaller ones");
}

TEST(Fans, shareTheirPole) {
  const GridMesh mesh = gridOf(uvSphere(16, 8));
  const auto south = static_cast<Index>(uvSphere(16, 8).positions.size()) - 2;
  std::map<Index, Index> collapsedAt;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h)
    if (mesh.collapsed[h]) ++collapsedAt[mesh.point[mesh.from(h)]];
  EXPECT_EQ(collapsedAt, (std::map<Index, Index>{{mesh.pointOfSource[south], 16},
                                                 {mesh.pointOfSource[south + 1], 16}}));
}

TEST(Fans, haveAVertexForEveryRayAtThePole) {
  const GridMesh mesh = gridOf(uvSphere(16, 8));
  EXPECT_EQ(mesh.pointCount(), 16 * 7 + 2);
  EXPECT_EQ(mesh.vertexCount(), 16 * 7 + 2 * 16);
}

TEST(Damage, aFaceOfTwoCornersHasNoSurfaceAndIsReported) {
  PolygonMesh mesh = plane(3, 3);
  addFace(mesh, {0, 1, 0});
  addFace(mesh, {5, 5, 5, 5});
  const GridMesh result = gridOf(mesh);
  EXPECT_EQ(result.quads.size(), 9u);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(result.warnings[0].starts_with("2 faces have fewer than three"))
      << result.warnings[0];
}

TEST(Damage, aRepeatedCornerIsCountedOnce) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  addFace(mesh, {0, 1, 1, 2, 3, 0});
  EXPECT_EQ(gridOf(mesh).quads.size(), 1u);
  EXPECT_TRUE(gridOf(mesh).warnings.empty());
}

TEST(Damage, aFaceOfNoAreaStays) {
  PolygonMesh mesh = plane(3, 3);
  mesh.positions[5] = 0.5 * (mesh.positions[4] + mesh.positions[6]);
  mesh.positions.push_back(0.5 * (mesh.positions[0] + mesh.positions[1]));
  addFace(mesh, {1, 0, 16});  // a sliver
  EXPECT_EQ(gridOf(mesh).quads.size(), 10u);
}

TEST(Damage, edgesOfThreeFacesAreCutAndReported) {
  PolygonMesh mesh = plane(4, 4);
  mesh.positions.push_back({2, 2, 9});
  addFace(mesh, {6, 7, 25});
  const GridMesh result = gridOf(mesh);
  EXPECT_EQ(result.quads.size(), 17u);
  EXPECT_EQ(openSides(result), 16 + 3 + 2);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(result.warnings[0].starts_with("1 edge joins more than two faces"))
      << result.warnings[0];
}

TEST(Damage, aFaceTurnedOverIsCutOutAndReported) {
  const PolygonMesh whole = plane(3, 3);
  PolygonMesh mesh{whole.positions, {}};
  std::vector<Loop> faces = loopsOf(whole.polygons);
  std::ranges::reverse(faces[4]);
  for (const Loop& face : faces) addFace(mesh, face);
  const GridMesh result = gridOf(mesh);
  EXPECT_EQ(result.quads.size(), 9u);
  EXPECT_EQ(openSides(result), 12 + 8);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(result.warnings[0].starts_with("4 edges join")) << result.warnings[0];
}

/// A sheet with every face given twice, the second time flipped if `turned`.
PolygonMesh doubled(const PolygonMesh& once, bool turned) {
  PolygonMesh mesh = once;
  for (Loop face : loopsOf(once.polygons)) {
    if (turned) std::ranges::reverse(face);
    std::ranges::rotate(face, face.begin() + 1);
    addFace(mesh, face);
  }
  return mesh;
}

TEST(Damage, aFaceGivenTwiceHasOneSurfaceAndIsReported) {
  const GridMesh result = gridOf(doubled(plane(3, 3), false));
  EXPECT_EQ(result.quads, gridOf(plane(3, 3)).quads);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_TRUE(result.warnings[0].starts_with("9 faces have the corners of another one"))
      << result.warnings[0];
}

TEST(Damage, theBackOfASheetIsASheetOfItsOwn) {
  const GridMesh result = gridOf(doubled(plane(3, 3), true));
  EXPECT_EQ(result.quads.size(), 18u);
  EXPECT_EQ(result.vertexCount(), 2 * 16);
  EXPECT_EQ(openSides(result), 2 * 12);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(Damage, facesThatTouchInAPointOnlyAreTwoFans) {
  PolygonMesh mesh;
  for (Index k = 0; k < 9; ++k) mesh.positions.push_back({1.0 * (k % 3), 1.0 * (k / 3), 0});
  addFace(mesh, {0, 1, 4, 3});
  addFace(mesh, {4, 5, 8, 7});
  const GridMesh result = gridOf(mesh);
  EXPECT_EQ(result.vertexCount(), 8);
  EXPECT_EQ(openSides(result), 8);
}

TEST(Damage, looseVerticesBelongToNoPoint) {
  PolygonMesh mesh = plane(3, 3);
  mesh.positions.insert(mesh.positions.begin() + 16, {7, 7, 7});
  const GridMesh result = gridOf(mesh);
  EXPECT_EQ(result.pointOfSource[16], -1);
  EXPECT_EQ(std::ranges::count(result.pointOfSource, -1), 1);
}

TEST(Damage, aMeshWithoutFacesIsRefused) {
  MeshRig rig;
  rig.neutral.positions = {{0, 0, 0}, {1, 0, 0}};
  const auto none = makeGridMesh(rig);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "the mesh has no face with an area; nothing can be converted");
}

}  // namespace
}  // namespace sweepface
