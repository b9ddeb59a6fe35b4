#include "sweepface/subdivision.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

MeshRig limitOf(const MeshRig& cage, int levels) {
  Result<Subdivision> limit = subdivide(cage, levels);
  EXPECT_TRUE(limit) << (limit ? "" : limit.error().message);
  return limit ? limit->rig : MeshRig{};
}
MeshRig limitOf(const PolygonMesh& cage, int levels) { return limitOf(MeshRig{cage, {}}, levels); }

std::string refusal(const MeshRig& cage, int levels = 1) {
  const Result<Subdivision> limit = subdivide(cage, levels);
  return limit ? "nothing" : limit.error().message;
}

/// A height that is nowhere smooth.
double rough(double x, double y) { return std::sin(31.7 * x + 17.3 * y * y); }
Vec3 onRough(double x, double y) { return {x, y, rough(x, y)}; }

/// The uniform cubic B-spline's weights of the four control points around `t`, and the first.
std::pair<std::array<double, 4>, int> cubic(double t) {
  const int first = static_cast<int>(std::floor(t)) - 1;
  const double u = t - first - 1;
  return {{(1 - u) * (1 - u) * (1 - u) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
           (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, u * u * u / 6},
          first};
}

double splineHeight(double x, double y) {
  const auto [a, i] = cubic(x);
  const auto [b, j] = cubic(y);
  double height = 0;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l) height += a[k] * b[l] * rough(i + k, j + l);
  return height;
}

/// The quads, each as the set of its corners' places, to a millionth.
std::set<std::set<std::array<long, 3>>> quadPlaces(const PolygonMesh& mesh) {
  std::set<std::set<std::array<long, 3>>> quads;
  for (const Loop& face : loopsOf(mesh.polygons)) {
    std::set<std::array<long, 3>> places;
    for (const Index v : face) {
      const Vec3& p = mesh.positions[v];
      places.insert({std::lround(1e6 * p.x), std::lround(1e6 * p.y), std::lround(1e6 * p.z)});
    }
    quads.insert(std::move(places));
  }
  return quads;
}

TEST(Subdivide, MakesTheBicubicSplineOfAGrid) {
  for (const int levels : {1, 2, 3}) {
    int compared = 0;
    for (const Vec3& p : limitOf(grid(8, 7, onRough), levels).neutral.positions)
      if (p.x > 1.01 && p.x < 6.99 && p.y > 1.01 && p.y < 5.99) {
        EXPECT_NEAR(p.z, splineHeight(p.x, p.y), 1e-12);
        ++compared;
      }
    EXPECT_EQ(compared, (6 * (1 << levels) - 1) * (5 * (1 << levels) - 1));
  }
}

// Halstead, Kass and DeRose 1993: (n² v + 4 Σ neighbours + Σ opposite corners) / (n (n + 5)).
TEST(Subdivide, MovesIrregularVerticesToTheirLimits) {
  for (const Index valence : {3, 4, 5, 6, 9}) {
    const PolygonMesh cage = pinwheel(valence);
    Vec3 sum = valence * valence * cage.positions[0];
    for (const Loop& face : loopsOf(cage.polygons))
      if (face[0] == 0)  // each neighbour is in two of them
        sum += 2 * cage.positions[face[1]] + cage.positions[face[2]] + 2 * cage.positions[face[3]];
    const Vec3 limit = (1.0 / (valence * (valence + 5))) * sum;
    for (const int levels : {1, 2})
      EXPECT_LT(norm(limitOf(cage, levels).neutral.positions[0] - limit), 1e-14);
  }
}

TEST(Subdivide, CutsEveryEdgeAndKeepsTheVerticesFirst) {
  const PolygonMesh cage = dart(5);
  const MeshRig once = limitOf(cage, 1), twice = limitOf(cage, 2);
  const auto faces = [](const MeshRig& rig) { return rig.neutral.polygons.faceCount(); };
  EXPECT_EQ(faces(once), std::ssize(cage.polygons.corners));
  EXPECT_EQ(faces(twice), 4 * faces(once));
  const Topology before = topologyOf(loopsOf(cage.polygons)),
                 after = topologyOf(loopsOf(twice.neutral.polygons));
  EXPECT_EQ(after.euler, before.euler);
  EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
  EXPECT_EQ(after.overfullEdges, 0);
  for (Index f = 0; f < faces(twice); ++f) EXPECT_EQ(twice.neutral.polygons.faceSize(f), 4);
  for (std::size_t v = 0; v < cage.positions.size(); ++v) {
    EXPECT_LT(norm(once.neutral.positions[v] - cage.positions[v]), 0.25) << v;
    EXPECT_LT(norm(once.neutral.positions[v] - twice.neutral.positions[v]), 1e-14) << v;
  }
}

TEST(Subdivide, KeepsOpenEdgesAsCurvesAndTheirCornersInPlace) {
  const PolygonMesh cage = grid(6, 5, onRough);
  const std::vector<Vec3> limit = limitOf(cage, 1).neutral.positions;
  for (const Index corner : {0, 6, 35, 41}) EXPECT_EQ(limit[corner], cage.positions[corner]);
  for (Index i = 1; i < 6; ++i)
    EXPECT_LT(norm(limit[i] - (1.0 / 6) * (cage.positions[i - 1] + 4 * cage.positions[i] +
                                           cage.positions[i + 1])),
              1e-15);
}

TEST(Subdivide, IsLinear) {
  const MeshRig cage = withTargets(cubeSphere(3), 2), limit = limitOf(cage, 2);
  ASSERT_EQ(limit.targets.size(), 2u);
  EXPECT_EQ(limit.targets[1].name, "target2");
  MeshRig mixed = cage;
  const auto mix = [](const MeshRig& rig, std::size_t v) {
    const Vec3& p = rig.neutral.positions[v];
    return p + 0.7 * (rig.targets[0].positions[v] - p) - 1.3 * (rig.targets[1].positions[v] - p);
  };
  for (std::size_t v = 0; v < cage.neutral.positions.size(); ++v)
    mixed.neutral.positions[v] = mix(cage, v);
  const std::vector<Vec3> of = limitOf(mixed, 2).neutral.positions;
  for (std::size_t v = 0; v < of.size(); ++v) EXPECT_LT(norm(of[v] - mix(limit, v)), 1e-13);
}

TEST(Subdivide, LeavesWhatATargetDoesNotMoveToTheBit) {
  MeshRig cage{plane(12, 12), {{"bump", plane(12, 12).positions}}};
  cage.targets[0].positions[0] += Vec3{0, 0, 1};
  const MeshRig limit = limitOf(cage, 2);
  int moved = 0;
  for (std::size_t v = 0; v < limit.neutral.positions.size(); ++v)
    moved += limit.neutral.positions[v] != limit.targets[0].positions[v];
  EXPECT_GT(moved, 4);
  EXPECT_LE(moved, 8 * 8);
}

TEST(Subdivide, ClosesSeams) {
  const MeshRig seam = limitOf(withTargets(cylinder(16, 8, true)), 1),
                closed = limitOf(withTargets(cylinder(16, 8, false)), 1);
  EXPECT_EQ(seam.neutral.positions.size(), closed.neutral.positions.size());
  EXPECT_EQ(quadPlaces(seam.neutral), quadPlaces(closed.neutral));
}

// Three sheets that touch along an edge are no fin.
TEST(Subdivide, KeepsApartWhatMerelyTouches) {
  const PolygonMesh sheet = grid(3, 3, [](double x, double y) { return Vec3{x, y, 0}; });
  PolygonMesh three = sheet;
  for (int k : {1, 2}) {
    PolygonMesh turned = sheet;
    for (Vec3& p : turned.positions) p = k == 1 ? Vec3{-p.x, p.y, p.x} : Vec3{-p.x, p.y, -p.x};
    three = joined(three, turned, {});
  }
  EXPECT_EQ(limitOf(three, 1).neutral.positions.size(),
            3 * limitOf(sheet, 1).neutral.positions.size());
}

TEST(Subdivide, ClosesSeamsAlsoUnderFacesWithoutAnArea) {
  PolygonMesh seam = cylinder(8, 4, true);
  const PolygonMesh closed = limitOf(seam, 1).neutral;
  addFace(seam, {9, 18, 26, 17});  // from one side of the seam to the other
  const PolygonMesh limit = limitOf(seam, 1).neutral;
  EXPECT_EQ(limit.positions.size(), closed.positions.size());
  EXPECT_EQ(quadPlaces(limit), quadPlaces(closed));
}

// Upper and lower lip touch in the neutral, and a target parts them.
TEST(Subdivide, KeepsApartWhatATargetParts) {
  PolygonMesh lips = joined(plane(4, 2), plane(4, 2), {0, 0, 0});
  for (std::size_t v = 0; v < 15; ++v) lips.positions[v].y *= -1;
  for (Loop face; Index f : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const auto first = lips.polygons.corners.begin() + 4 * f;
    std::reverse(first, first + 4);
  }
  MeshRig cage{lips, {{"open", lips.positions}}};
  EXPECT_EQ(topologyOf(loopsOf(limitOf(lips, 1).neutral.polygons)).boundaryLoops, 1);
  for (std::size_t v = 15; v < 30; ++v) cage.targets[0].positions[v].y += 1;
  EXPECT_EQ(topologyOf(loopsOf(limitOf(cage, 1).neutral.polygons)).boundaryLoops, 2);
}

/// A sheet whose texture has a seam in the middle and stretches over [0, 1]² on each side. One face
/// has no texture.
PolygonMesh textured() {
  PolygonMesh mesh = grid(8, 4, onRough);
  Polygons& p = mesh.polygons;
  p.materials = {"skin", "lips"}, p.groups = {"left", "right"};
  for (int side : {0, 1})
    for (int j = 0; j <= 4; ++j)
      for (int i = 0; i <= 4; ++i) p.texcoords.push_back({i / 4.0, j / 4.0 + 2 * side});
  for (Index f = 0; f < p.faceCount(); ++f) {
    const Index i = f % 8, j = f / 8, side = i / 4;
    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      p.cornerTexcoords.push_back(f == 0 ? -1 : 25 * side + 5 * (j + b) + i % 4 + a);
    p.faceMaterial.push_back(j == 3 ? -1 : j % 2), p.faceGroup.push_back(side);
  }
  return mesh;
}

TEST(Subdivide, HandsDownTexturesMaterialsAndGroups) {
  const PolygonMesh cage = textured(), limit = limitOf(cage, 2).neutral;
  const Polygons& p = limit.polygons;
  EXPECT_EQ(p.materials, cage.polygons.materials);
  EXPECT_EQ(p.groups, cage.polygons.groups);
  ASSERT_EQ(p.faceMaterial.size(), p.faceGroup.size());
  ASSERT_EQ(p.cornerTexcoords.size(), p.corners.size());
  double widest = 0;
  int without = 0;
  for (Index f = 0; f < p.faceCount(); ++f) {
    Vec3 middle;
    for (Index c = 4 * f; c < 4 * f + 4; ++c) middle += 0.25 * limit.positions[p.corners[c]];
    const int row = static_cast<int>(middle.y), right = middle.x > 4;
    EXPECT_EQ(p.faceMaterial[f], row == 3 ? -1 : row % 2) << f;
    EXPECT_EQ(p.faceGroup[f], right) << f;
    for (Index c = 4 * f; c < 4 * f + 4; ++c) {
      if (p.cornerTexcoords[c] < 0) {
        ++without;
        EXPECT_TRUE(middle.x < 1 && middle.y < 1) << f;
        continue;
      }
      const Vec2 t = p.texcoords[p.cornerTexcoords[c]];
      const Vec3& at = limit.positions[p.corners[c]];
      widest = std::max(
          {widest, std::abs(at.x - 4 * (t.x + right)), std::abs(at.y - 4 * (t.y - 2 * right))});
    }
  }
  EXPECT_EQ(without, 4 * 16);
  EXPECT_GT(widest, 0);  // where the texture ends and the surface goes on
  EXPECT_LT(widest, 0.3);
}

/// The texture coordinates that the corners at a vertex have.
std::set<std::pair<double, double>> textureAt(const PolygonMesh& mesh, Index vertex) {
  std::set<std::pair<double, double>> places;
  for (std::size_t c = 0; c < mesh.polygons.corners.size(); ++c)
    if (mesh.polygons.corners[c] == vertex) {
      const Vec2& t = mesh.polygons.texcoords[mesh.polygons.cornerTexcoords[c]];
      places.emplace(t.x, t.y);
    }
  return places;
}

TEST(Subdivide, SmoothsTexturesAsItSmoothsTheMesh) {
  PolygonMesh cage = grid(6, 5, onRough);
  for (Vec3& p : cage.positions) p.x += 0.2 * p.z, p.y -= 0.3 * p.z, p.z = 0;
  for (const Vec3& p : cage.positions) cage.polygons.texcoords.push_back({p.x, p.y});
  cage.polygons.cornerTexcoords = cage.polygons.corners;
  for (const int levels : {1, 2}) {
    const PolygonMesh limit = limitOf(cage, levels).neutral;
    for (Index v = 0; v < std::ssize(limit.positions); ++v) {
      const auto places = textureAt(limit, v);
      ASSERT_EQ(places.size(), 1u);
      EXPECT_NEAR(places.begin()->first, limit.positions[v].x, 1e-14);
      EXPECT_NEAR(places.begin()->second, limit.positions[v].y, 1e-14);
    }
  }
}

// Where three islands meet, none of them is rounded, though one goes straight on there.
TEST(Subdivide, KeepsTexturesSharpWhereIslandsMeet) {
  PolygonMesh cage = grid(2, 2, [](double x, double y) { return Vec3{x, y, 0}; });
  Polygons& p = cage.polygons;
  for (Index f = 0; f < 4; ++f)
    for (Index c = 4 * f; c < 4 * f + 4; ++c) {
      const Vec3& at = cage.positions[p.corners[c]];
      p.cornerTexcoords.push_back(c);
      p.texcoords.push_back({at.x * at.x, at.y + (f == 0 ? 5 : f == 1 ? 9 : 0) + 0.1 * at.x});
    }
  EXPECT_EQ(textureAt(limitOf(cage, 1).neutral, 4), textureAt(cage, 4));
}

// As on faces whose halves have the same texture.
TEST(Subdivide, TellsPartsApartThatLieUponEachOtherInTheTexture) {
  PolygonMesh one = grid(3, 3, onRough);
  const std::vector<Index> corners = one.polygons.corners;
  PolygonMesh cage = joined(one, one, {10, 0, 0});
  for (PolygonMesh* mesh : {&one, &cage}) {
    for (const Vec3& p : one.positions) mesh->polygons.texcoords.push_back({p.x + 0.2 * p.z, p.y});
    mesh->polygons.cornerTexcoords = corners;
  }
  cage.polygons.cornerTexcoords.insert(cage.polygons.cornerTexcoords.end(), corners.begin(),
                                       corners.end());
  const PolygonMesh limit = limitOf(cage, 1).neutral, half = limitOf(one, 1).neutral;
  for (Index v = 0; v < 16; ++v) {
    EXPECT_EQ(textureAt(limit, v), textureAt(half, v));
    EXPECT_EQ(textureAt(limit, v + 16), textureAt(half, v));
  }
}

TEST(Subdivide, EndsTexturesAtFacesWithoutThem) {
  PolygonMesh cage = grid(2, 1, [](double x, double y) { return Vec3{x, y, 0}; });
  cage.polygons.texcoords = {{0, 0}, {1, 0}, {1, 1}};
  cage.polygons.cornerTexcoords = {-1, -1, -1, -1, 0, 1, 2, 0};
  const PolygonMesh limit = limitOf(cage, 1).neutral;
  int atEdge = 0;
  for (std::size_t c = 0; c < limit.polygons.corners.size(); ++c)
    if (const Index t = limit.polygons.cornerTexcoords[c];
        t >= 0 && std::abs(limit.positions[limit.polygons.corners[c]].x - 1) < 0.3) {
      EXPECT_EQ(limit.polygons.texcoords[t], (Vec2{0, 0}));
      ++atEdge;
    }
  EXPECT_EQ(atEdge, 4);
}

// Away from where it ends, a texture that lies flat on a flat mesh goes on doing so.
TEST(Subdivide, KeepsFlatTexturesFlat) {
  PolygonMesh cage = grid(6, 6, [](double x, double y) { return Vec3{x, y, 0}; });
  for (const Vec3& p : cage.positions) cage.polygons.texcoords.push_back({p.x / 6, p.y / 6});
  cage.polygons.cornerTexcoords = cage.polygons.corners;
  const PolygonMesh limit = limitOf(cage, 2).neutral;
  const Polygons& p = limit.polygons;
  EXPECT_EQ(p.texcoords.size(), limit.positions.size());
  for (std::size_t c = 0; c < p.corners.size(); ++c) {
    const Vec3& at = limit.positions[p.corners[c]];
    EXPECT_NEAR(6 * p.texcoords[p.cornerTexcoords[c]].x, at.x, 1e-14);
    EXPECT_NEAR(6 * p.texcoords[p.cornerTexcoords[c]].y, at.y, 1e-14);
  }
}

TEST(Subdivide, KeepsLooseVertices) {
  PolygonMesh cage = cubeSphere(2);
  cage.positions.insert(cage.positions.begin(), {7, 8, 9});
  for (Index& v : cage.polygons.corners) ++v;
  const MeshRig limit = limitOf(cage, 2);
  EXPECT_EQ(limit.neutral.positions[0], (Vec3{7, 8, 9}));
  EXPECT_EQ(std::ranges::count(limit.neutral.polygons.corners, 0), 0);
}

// Repeated corners count once, and what has fewer than three is no face.
TEST(Subdivide, TakesFacesThatRunToAPoint) {
  PolygonMesh cage = plane(4, 4), same = cage;
  addFace(cage, {3, 3, 2});
  for (const Loop& face : loopsOf(uvSphere().polygons)) addFace(same, face), addFace(cage, face);
  cage.polygons.corners.insert(cage.polygons.corners.begin() + 2, cage.polygons.corners[1]);
  for (Index& start : cage.polygons.faceStart) start += start > 0;
  for (PolygonMesh* mesh : {&cage, &same})
    for (const Vec3& p : uvSphere().positions) mesh->positions.push_back(p);
  EXPECT_EQ(quadPlaces(limitOf(cage, 1).neutral), quadPlaces(limitOf(same, 1).neutral));
}

TEST(Subdivide, LeavesOutFacesThatAreThereAgain) {
  const PolygonMesh cage = cubeSphere(3);
  PolygonMesh twice = cage;
  for (Loop face : {loopsOf(cage.polygons)[4], loopsOf(cage.polygons)[9]}) {
    std::ranges::rotate(face, face.begin() + 1);
    addFace(twice, face);
  }
  addFace(twice, {1, 1, 2});
  const Result<Subdivision> limit = subdivide({twice, {}}, 1);
  ASSERT_TRUE(limit);
  EXPECT_EQ(quadPlaces(limit->rig.neutral), quadPlaces(limitOf(cage, 1).neutral));
  EXPECT_EQ(limit->rig.neutral.positions.size(), limitOf(cage, 1).neutral.positions.size());
  ASSERT_EQ(limit->warnings.size(), 2u);
  EXPECT_EQ(limit->warnings[0],
            "1 face has fewer than three different corners and no surface to subdivide.");
  EXPECT_EQ(limit->warnings[1],
            "2 faces have the corners of another one and no surface of their own; leave them out.");
}

// Lashes and hair cards: faces modelled from both sides.
TEST(Subdivide, KeepsASheetAndItsBackApart) {
  const PolygonMesh sheet = plane(4, 3);
  PolygonMesh both = sheet;
  for (Loop face : loopsOf(sheet.polygons)) {
    std::ranges::reverse(face);
    addFace(both, face);
  }
  const PolygonMesh limit = limitOf(both, 1).neutral, one = limitOf(sheet, 1).neutral;
  EXPECT_EQ(limit.positions.size(), 2 * one.positions.size());
  EXPECT_EQ(topologyOf(loopsOf(limit.polygons)).overfullEdges, 0);
  EXPECT_EQ(quadPlaces(limit), quadPlaces(one));
}

class SubdivideEach : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Faces, SubdivideEach, eachFace(), faceName);

TEST_P(SubdivideEach, TakesDamagedMeshes) {
  for (unsigned seed = 0; seed < 64; ++seed) {
    MeshRig cage = GetParam().rig;
    cage.neutral = damaged(cage.neutral, seed);
    const MeshRig limit = limitOf(cage, 1 + static_cast<int>(seed % 2));
    EXPECT_TRUE(std::ranges::all_of(limit.neutral.positions, isFinite)) << seed;
    EXPECT_TRUE(std::ranges::all_of(limit.targets[1].positions, isFinite)) << seed;
    EXPECT_EQ(limit.neutral.polygons.corners.size(), 4u * limit.neutral.polygons.faceCount());
  }
}

TEST(Subdivide, RefusesWhatItCannotDo) {
  const MeshRig good{plane(), {}};
  for (const int levels : {-1, 0, 6})
    EXPECT_EQ(refusal(good, levels),
              "there are 1 to 5 levels of subdivision, not " + std::to_string(levels));
  EXPECT_EQ(refusal({}), "the mesh has no face with an area to be subdivided");
  PolygonMesh edge{{{}, {1, 0, 0}}, {}};
  addFace(edge, {0, 1, 1});
  EXPECT_EQ(refusal({edge, {}}), "the mesh has no face with an area to be subdivided");
  MeshRig bad = good;
  bad.neutral.polygons.corners[3] = 99;
  EXPECT_NE(refusal(bad).find("corner 3"), std::string::npos) << refusal(bad);
  const MeshRig many{grid(512, 512, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
  EXPECT_EQ(refusal(many, 3),
            "at level 3 of subdivision the mesh would have 16777216 faces, of which 4194304 are "
            "allowed; subdivide it less");
}

// OpenSubdiv counts to 65,535 around a vertex.
TEST(Subdivide, RefusesPolesOfTensOfThousandsOfFaces) {
  EXPECT_EQ(refusal({uvSphere(40'000, 3), {}}),
            "too many faces around a vertex, or corners around a face, to be subdivided");
  EXPECT_EQ(refusal({uvSphere(32'000, 3), {}}), "nothing");
  PolygonMesh disc;
  Loop rim;
  for (Index v = 0; v < 40'000; ++v) {
    disc.positions.push_back({std::cos(turn(v / 40'000.0)), std::sin(turn(v / 40'000.0)), 0});
    rim.push_back(v);
  }
  addFace(disc, rim);
  EXPECT_EQ(refusal({disc, {}}),
            "too many faces around a vertex, or corners around a face, to be subdivided");
}

}  // namespace
}  // namespace sweepface
