#include "mesh/quads.hpp"

#include "sweepface/io.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// ---- Quads cut into triangles ----

enum class Diagonal { first, second, shorter, any };
enum class Listed { inOrder, shuffled };

bool cutsSecond(const PolygonMesh& mesh, const Loop& quad, Diagonal diagonal,
                std::mt19937& random) {
  const auto apart = [&](std::size_t a, std::size_t b) {
    return norm(mesh.positions[quad[a]] - mesh.positions[quad[b]]);
  };
  switch (diagonal) {
    case Diagonal::first:
      return false;
    case Diagonal::second:
      return true;
    case Diagonal::shorter:
      return apart(1, 3) < apart(0, 2);
    case Diagonal::any:
      return random() % 2 == 1;
  }
  return false;
}

/// The same surface with every quad cut into triangles. Shuffling changes the order of vertices,
/// triangles and their corners.
MeshRig cut(const MeshRig& rig, Diagonal diagonal, Listed listed = Listed::inOrder) {
  std::mt19937 random(7);
  std::vector<Loop> faces;
  for (const Loop& f : loopsOf(rig.neutral.polygons)) {
    if (f.size() != 4) {
      faces.push_back(f);
    } else if (cutsSecond(rig.neutral, f, diagonal, random)) {
      faces.insert(faces.end(), {{f[0], f[1], f[3]}, {f[1], f[2], f[3]}});
    } else {
      faces.insert(faces.end(), {{f[0], f[1], f[2]}, {f[0], f[2], f[3]}});
    }
  }
  std::vector<Index> place(rig.neutral.positions.size());
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = static_cast<Index>(v);
  const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  if (listed == Listed::shuffled) {
    for (std::size_t v = place.size(); v > 1; --v) std::swap(place[v - 1], place[any(v)]);
    for (std::size_t f = faces.size(); f > 1; --f) std::swap(faces[f - 1], faces[any(f)]);
  }
  MeshRig result = rig;
  result.neutral.polygons = {};
  const auto move = [&](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
    for (std::size_t v = 0; v < place.size(); ++v) to[place[v]] = from[v];
  };
  move(rig.neutral.positions, result.neutral.positions);
  for (std::size_t t = 0; t < rig.targets.size(); ++t)
    move(rig.targets[t].positions, result.targets[t].positions);
  for (Loop& face : faces) {
    for (Index& v : face) v = place[v];
    if (listed == Listed::shuffled)
      std::ranges::rotate(face, face.begin() + static_cast<std::ptrdiff_t>(any(face.size())));
    addFace(result.neutral, face);
  }
  return result;
}

using Place = std::array<double, 3>;

/// The quads of a mesh, each as the set of its corner positions.
std::set<std::set<Place>> quadsOf(const PolygonMesh& mesh) {
  std::set<std::set<Place>> quads;
  for (const Loop& face : loopsOf(mesh.polygons)) {
    std::set<Place> places;
    for (Index v : face)
      places.insert({mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
    if (face.size() == 4) quads.insert(places);
  }
  return quads;
}

/// The share of the quads of `rig` that are recovered after cutting.
double shareRecovered(const MeshRig& rig, Diagonal diagonal, Listed listed) {
  const MeshRig pieces = cut(rig, diagonal, listed);
  const auto before = quadsOf(rig.neutral);
  const auto after = quadsOf({pieces.neutral.positions, recoverQuads(pieces).polygons});
  std::size_t same = 0;
  for (const auto& quad : before) same += after.count(quad);
  return static_cast<double>(same) / static_cast<double>(before.size());
}

constexpr auto everyDiagonal = {Diagonal::first, Diagonal::second, Diagonal::shorter,
                                Diagonal::any};

class CutFace : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Quads, CutFace, eachFace(), faceName);

TEST_P(CutFace, isWholeAgain) {
  for (Diagonal diagonal : everyDiagonal)
    EXPECT_EQ(shareRecovered(GetParam().rig, diagonal, Listed::inOrder), 1)
        << static_cast<int>(diagonal);
}

TEST_P(CutFace, isWholeAgainWithoutItsOrder) {
  for (Diagonal diagonal : everyDiagonal)
    EXPECT_EQ(shareRecovered(GetParam().rig, diagonal, Listed::shuffled), 1)
        << static_cast<int>(diagonal);
}

TEST_P(CutFace, keepsItsShape) {
  for (Diagonal diagonal : everyDiagonal)
    for (Listed listed : {Listed::inOrder, Listed::shuffled}) {
      MeshRig rig = cut(GetParam().rig, diagonal, listed);
      const Topology before = topologyOf(weldedLoops(rig));
      rig.neutral.polygons = recoverQuads(rig).polygons;
      EXPECT_EQ(topologyOf(weldedLoops(rig)), before);
    }
}

TEST_P(CutFace, withoutTrianglesStaysAsItIs) {
  const MeshRig& rig = GetParam().rig;
  std::vector<Loop> larger = loopsOf(rig.neutral.polygons);
  std::erase_if(larger, [](const Loop& face) { return face.size() == 3; });
  PolygonMesh mesh{rig.neutral.positions, {}};
  for (const Loop& face : larger) addFace(mesh, face);
  EXPECT_EQ(loopsOf(recoverQuads({mesh, {}}).polygons), larger);
}

// ---- What two triangles need to become a quad ----

/// Two triangles that share the diagonal from (0, 0, 0) to (1, 1, 0), with the given other corners.
MeshRig halves(const Vec3& right, const Vec3& left) {
  MeshRig rig;
  rig.neutral.positions = {{0, 0, 0}, right, {1, 1, 0}, left};
  addFace(rig.neutral, {0, 1, 2});
  addFace(rig.neutral, {0, 2, 3});
  return rig;
}
MeshRig halves() { return halves({1, 0, 0}, {0, 1, 0}); }

bool joins(const MeshRig& rig, std::span<const Index> copies = {}) {
  const RecoveredQuads result = recoverQuads(rig, copies);
  EXPECT_EQ(result.polygons.faceCount(), 2 - result.recovered);
  EXPECT_EQ(result.triangles, 2 - 2 * result.recovered);
  return result.recovered == 1;
}

/// Fanning the quad from its first corner yields the first triangle and then the second.
TEST(Halves, makeAQuadThatBeginsOnItsDiagonal) {
  EXPECT_EQ(loopsOf(recoverQuads(halves()).polygons), (std::vector<Loop>{{0, 1, 2, 3}}));
  for (const auto& [a, b, quad] : {std::tuple<Loop, Loop, Loop>{{1, 2, 0}, {2, 3, 0}, {0, 1, 2, 3}},
                                   {{2, 0, 1}, {3, 0, 2}, {0, 1, 2, 3}},
                                   {{2, 3, 0}, {0, 1, 2}, {2, 3, 0, 1}}}) {
    MeshRig rig = halves();
    rig.neutral.polygons = {};
    addFace(rig.neutral, a);
    addFace(rig.neutral, b);
    EXPECT_EQ(loopsOf(recoverQuads(rig).polygons), std::vector<Loop>{quad});
  }
}

TEST(Halves, needAConvexOutline) {
  EXPECT_TRUE(joins(halves({1.2, 0.1, 0}, {0.1, 1, 0})));
  EXPECT_FALSE(joins(halves({2, 1.5, 0}, {0.1, 1, 0}))) << "concave on the diagonal";
  EXPECT_FALSE(joins(halves({0.4, 0.6, 0}, {0, 1, 0}))) << "concave opposite the diagonal";
}

TEST(Halves, mustNotBeFolded) {
  EXPECT_TRUE(joins(halves({1, 0, 0}, {0.4, 0.6, 0.6})));
  EXPECT_FALSE(joins(halves({1, 0, 0}, {0.9, 0.1, 0.2})));
  EXPECT_FALSE(joins(halves({1, 0, 0}, {0.93, 0.07, 0.35}))) << "by 150 degrees";
}

TEST(Halves, needAnArea) {
  EXPECT_FALSE(joins(halves({0.5, 0.5, 0}, {0, 1, 0})));
  EXPECT_FALSE(joins(halves({0, 0, 0}, {0, 1, 0})));
  EXPECT_FALSE(joins(halves({1e-300, 0, 0}, {0, 1, 0})));
}

TEST(Halves, mustFaceTheSameSide) {
  MeshRig rig = halves();
  std::swap(rig.neutral.polygons.corners[4], rig.neutral.polygons.corners[5]);
  EXPECT_FALSE(joins(rig));
}

TEST(Halves, needFourDifferentCorners) {
  MeshRig rig = halves();
  rig.neutral.polygons = {};
  addFace(rig.neutral, {0, 1, 2});
  addFace(rig.neutral, {0, 2, 1});
  EXPECT_FALSE(joins(rig));
}

TEST(Halves, needTheSameMaterialAndGroup) {
  for (auto list : {&Polygons::faceMaterial, &Polygons::faceGroup}) {
    MeshRig rig = halves();
    rig.neutral.polygons.*list = {4, 4};
    EXPECT_TRUE(joins(rig));
    EXPECT_EQ(recoverQuads(rig).polygons.*list, std::vector<Index>{4});
    rig.neutral.polygons.*list = {4, 5};
    EXPECT_FALSE(joins(rig));
    EXPECT_EQ(recoverQuads(rig).polygons.*list, (std::vector<Index>{4, 5}));
  }
}

TEST(Halves, bringTheirTexcoords) {
  MeshRig rig = halves();
  rig.neutral.polygons.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {0.5, 0.5}};
  rig.neutral.polygons.cornerTexcoords = {0, 1, 2, 0, 4, 3};
  EXPECT_TRUE(joins(rig)) << "2 and 4 are the same";
  EXPECT_EQ(recoverQuads(rig).polygons.cornerTexcoords, (std::vector<Index>{0, 1, 2, 3}));
  rig.neutral.polygons.cornerTexcoords = {0, 1, 2, 0, 5, 3};
  EXPECT_FALSE(joins(rig)) << "a seam along the diagonal";
  rig.neutral.polygons.cornerTexcoords = {0, 1, 2, 0, -1, 3};
  EXPECT_FALSE(joins(rig));
}

TEST(Halves, needTheSameVerticesOrCopiesOnTheDiagonal) {
  MeshRig rig = halves();
  rig.neutral.positions.push_back(rig.neutral.positions[2]);
  rig.neutral.polygons.corners[4] = 4;
  EXPECT_FALSE(joins(rig));
  EXPECT_FALSE(joins(rig, std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(joins(rig, std::vector<Index>{0, 1, 2, 3, 2}));
  rig.targets.push_back({"parted", rig.neutral.positions});
  rig.targets[0].positions[4].z += 1;
  EXPECT_FALSE(joins(rig, std::vector<Index>{0, 1, 2, 3, 2}));
}

TEST(Halves, mustNotMeetAtAnEdgeOfThreeFaces) {
  MeshRig rig = halves();
  rig.neutral.positions.push_back({0.5, 0.5, 1});
  addFace(rig.neutral, {0, 2, 4});
  EXPECT_EQ(recoverQuads(rig).recovered, 0);
}

TEST(Halves, ofTheGreatestAndSmallestSizeAreJudgedAlike) {
  for (double size : {1e-30, 1e38}) {
    MeshRig rig = halves();
    for (Vec3& p : rig.neutral.positions) p *= size;
    EXPECT_TRUE(joins(rig)) << size;
  }
}

// ---- Meshes ----

TEST(Quads, areFoundOnBothSidesOfASeam) {
  const MeshRig rig = withTargets(cylinder(12, 4, true));
  const RecoveredQuads result = recoverQuads(cut(rig, Diagonal::shorter, Listed::shuffled));
  EXPECT_EQ(result.recovered, 12 * 4);
}

TEST(Quads, standWhereTheirFirstHalvesStood) {
  const MeshRig rig{plane(), {}};
  EXPECT_EQ(loopsOf(recoverQuads(cut(rig, Diagonal::first)).polygons),
            loopsOf(rig.neutral.polygons));
}

TEST(Quads, areNotMisledByOddTrianglesInBetween) {
  MeshRig rig{dart(3, 9, 9), {}};
  std::vector<Loop> faces = loopsOf(rig.neutral.polygons);
  const auto triangle = std::ranges::find_if(faces, [](const Loop& f) { return f.size() == 3; });
  for (std::ptrdiff_t at : {0, 1, 40, 81}) {
    std::vector<Loop> order = faces;
    order.erase(order.begin() + (triangle - faces.begin()));
    order.insert(order.begin() + at, *triangle);
    rig.neutral.polygons = {};
    for (const Loop& face : order) addFace(rig.neutral, face);
    EXPECT_EQ(loopsOf(recoverQuads(cut(rig, Diagonal::first)).polygons), order);
  }
}

struct Cut {
  double stretch, jitter;
  Diagonal diagonal;
  Listed listed;
};

// Their shapes alone do not tell which triangles were quads.
TEST(Quads, ofUnevenSheetsAllComeBack) {
  for (const Cut& how : {Cut{2, 0.3, Diagonal::shorter, Listed::inOrder},
                         {2, 0.3, Diagonal::first, Listed::shuffled},
                         {3, 0.25, Diagonal::first, Listed::shuffled}}) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-how.jitter, how.jitter);
    const MeshRig sheet{grid(24, 24,
                             [&](double i, double j) {
                               const double x = i + off(random);
                               return Vec3{how.stretch * x, j + off(random), 0};
                             }),
                        {}};
    EXPECT_EQ(shareRecovered(sheet, how.diagonal, how.listed), 1)
        << how.stretch << ' ' << how.jitter;
  }
}

// A sphere made only of triangles, whose rings differ in their number of vertices towards the
// poles.
PolygonMesh triangleSphere(Index rings) {
  PolygonMesh mesh;
  std::vector<Index> start, size;
  for (Index j = 0; j <= rings; ++j) {
    const double down = std::numbers::pi * j / rings;
    start.push_back(static_cast<Index>(mesh.positions.size()));
    size.push_back(std::max<Index>(1, static_cast<Index>(std::lround(2 * rings * std::sin(down)))));
    for (Index i = 0; i < size[j]; ++i) {
      const double a = turn((i + 0.31 * j) / size[j]);
      mesh.positions.push_back(
          {std::sin(down) * std::cos(a), std::sin(down) * std::sin(a), std::cos(down)});
    }
  }
  for (Index j = 0; j < rings; ++j)
    for (Index i = 0, k = 0; i < size[j] || k < size[j + 1];) {
      const Index a = start[j] + i % size[j], b = start[j + 1] + k % size[j + 1];
      const bool above =
          k == size[j + 1] || (i < size[j] && (i + 0.5) / size[j] < (k + 0.5) / size[j + 1]);
      if (above ? size[j] > 1 : size[j + 1] > 1)
        addFace(mesh, above ? Loop{a, b, start[j] + (i + 1) % size[j]}
                            : Loop{a, b, start[j + 1] + (k + 1) % size[j + 1]});
      ++(above ? i : k);
    }
  return mesh;
}

double smallestTurn(const PolygonMesh& mesh, const Loop& face) {
  const auto at = [&](std::size_t k) { return mesh.positions[face[k % face.size()]]; };
  const Vec3 normal = cross(at(2) - at(0), at(3) - at(1));
  double smallest = 180;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3 in = at(k + 1) - at(k), out = at(k + 2) - at(k + 1);
    const double sign = dot(cross(in, out), normal) > 0 ? 1 : -1;
    smallest = std::min(smallest, sign * angleDegrees(in, out));
  }
  return smallest;
}

TEST(Quads, ofAMeshOfTrianglesAreSound) {
  const PolygonMesh triangles = triangleSphere(24);
  const auto before = topologyOf(loopsOf(triangles.polygons));
  ASSERT_EQ(before.euler, 2);
  ASSERT_EQ(before.overfullEdges, 0);
  const RecoveredQuads result = recoverQuads({triangles, {}});
  const auto faces = loopsOf(result.polygons);
  EXPECT_EQ(topologyOf(faces), before);
  EXPECT_LT(result.triangles, triangles.polygons.faceCount() / 10);
  std::map<Index, int> valence;
  for (const Loop& face : faces) {
    for (Index v : face) ++valence[v];
    if (face.size() == 4) {
      EXPECT_GT(smallestTurn(triangles, face), -5);
    }
  }
  for (const auto& [vertex, count] : valence) EXPECT_GE(count, 3) << vertex;
}

TEST(Quads, ofATetrahedronWouldShareTwoEdges) {
  PolygonMesh mesh;
  mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  for (const Loop& face : {Loop{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}) addFace(mesh, face);
  EXPECT_EQ(recoverQuads({mesh, {}}).recovered, 0);
}

TEST(Quads, ofDamagedMeshesKeepTheirShape) {
  for (unsigned seed = 0; seed < 64; ++seed) {
    MeshRig rig = cut({damaged(plane(), seed), {}}, Diagonal::any, Listed::shuffled);
    const Topology before = topologyOf(weldedLoops(rig));
    rig.neutral.polygons = recoverQuads(rig).polygons;
    EXPECT_EQ(topologyOf(weldedLoops(rig)), before) << seed;
  }
}

TEST(Quads, ofNothingAreNone) { EXPECT_EQ(recoverQuads({}).polygons.faceCount(), 0); }

// ---- Real faces ----

class RealQuads : public ::testing::TestWithParam<Diagonal> {};
INSTANTIATE_TEST_SUITE_P(Cut, RealQuads, ::testing::ValuesIn(everyDiagonal));
class RealQuadsLong : public RealQuads {};
INSTANTIATE_TEST_SUITE_P(Cut, RealQuadsLong, ::testing::ValuesIn(everyDiagonal));

double realShare(const char* file, Diagonal diagonal, Listed listed) {
  const auto mesh = readMesh(std::filesystem::path(realFaces()) / file);
  if (!mesh) ADD_FAILURE() << mesh.error().message;
  return mesh ? shareRecovered({*mesh, {}}, diagonal, listed) : 0;
}

TEST_P(RealQuads, ofAHeadComeBack) {
  SKIP_WITHOUT_REAL_FACES();
  // Two or four of the 11 144 quads are folded so sharply along a diagonal that they stay cut.
  for (Listed listed : {Listed::inOrder, Listed::shuffled})
    EXPECT_GE(realShare("ictface/head/neutral.obj", GetParam(), listed), 0.9998);
  EXPECT_EQ(realShare("makehuman/neutral.obj", GetParam(), Listed::shuffled), 1);
}

TEST_P(RealQuadsLong, amongTrianglesComeBack) {
  SKIP_WITHOUT_REAL_FACES();
  EXPECT_GE(realShare("ictface/neutral.obj", GetParam(), Listed::inOrder), 0.9997);
  EXPECT_GE(realShare("ictface/neutral.obj", GetParam(), Listed::shuffled), 0.988);
}

}  // namespace
}  // namespace sweepface
