// GLB files of faces that came without a scene.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A sheet whose second target moves only a corner.
MeshRig sheetRig() {
  MeshRig rig = withTargets(plane(8, 6), 1);
  MeshTarget corner{"corner", rig.neutral.positions};
  for (Vec3& p : corner.positions)
    if (p.x < 2 && p.y < 2) p.z += 0.5 * (2 - p.x) * (2 - p.y);
  rig.targets.push_back(std::move(corner));
  return rig;
}

/// The displacements by a target at the vertices of the source.
std::vector<Vec3> surfaceDifference(const Rig& rig, std::size_t target) {
  std::vector<Vec3> moved = surfacePositions(rig, oneTarget(rig, target));
  const std::vector<Vec3> neutral = surfacePositions(rig);
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] -= neutral[v];
  return moved;
}

class EveryFace : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(GlbWriter, EveryFace, eachFace(), faceName);

TEST_P(EveryFace, HoldsTheSurfaceInSinglePrecision) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Written glb = write(rig);
  const std::vector<Vec3> neutral = surfacePositions(rig);
  expectSingle(glb.vectors(glb.attribute("POSITION")), neutral);
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    expectNear(glb.vectors(glb.morph(k)), surfaceDifference(rig, k),
               2 * largest(neutral) / (1 << 24));
}

TEST_P(EveryFace, KeepsToABudget) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Budget budget{Budget::Kind::error, 0.05};
  const Tessellation grid(rig.surface, densityFor(rig.surface, blend(rig, {}), budget).value());
  GlbOptions options;
  options.grid = &grid;
  const Written glb = write(rig, options);
  const std::vector<Vec3> expected = grid.positions(blend(rig, {}));
  std::vector<Vec3> neutral = glb.vectors(glb.attribute("POSITION"));
  std::size_t triangles = 0;
  for (std::size_t part = 0; part < glb.json["meshes"][0]["primitives"].size(); ++part)
    triangles += glb.indices(0, part).size() / 3;
  EXPECT_EQ(triangles, grid.triangles().size());
  neutral.resize(expected.size());  // the rest differ only in texture coordinates
  expectSingle(neutral, expected);
  for (std::size_t k = 0; k < rig.targets.size(); ++k) {
    std::vector<Vec3> moved = glb.vectors(glb.morph(k));
    moved.resize(expected.size());
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += expected[v];
    expectNear(moved, grid.positions(blend(rig, oneTarget(rig, k))),
               4 * largest(expected) / (1 << 24));
  }
}

TEST(GlbWriter, RefusesABudgetWhereItCannotBeKept) {
  const Rig rig = converted(withTargets(plane(3, 3)), 0.2), other = converted(smallFace());
  const auto gridOf = [](const Rig& of) {
    const Budget budget{Budget::Kind::edgeLength, 0.5};
    return Tessellation(of.surface, densityFor(of.surface, blend(of, {}), budget).value());
  };
  const Tessellation mine = gridOf(rig), its = gridOf(other), level(rig.surface, 1);
  GlbOptions options;
  options.grid = &mine, options.lod = 2;
  EXPECT_TRUE(failsWith(formatGlb(rig, options), {"ask for one of them"}));
  options.lod = 0, options.grid = &level;
  EXPECT_TRUE(failsWith(formatGlb(rig, options), {"not one of the face with a density"}));
  options.grid = &its;
  EXPECT_TRUE(failsWith(formatGlb(rig, options), {"not one of the face with a density"}));
}

TEST(GlbWriter, RefusesTextureCoordinatesThatAreNoNumbers) {
  for (const double bad : {std::nan(""), 1e300}) {
    MeshRig meshes{plane(2, 2), {}};
    meshes.neutral.polygons.texcoords = {{0, bad}};
    meshes.neutral.polygons.cornerTexcoords.assign(meshes.neutral.polygons.corners.size(), 0);
    EXPECT_TRUE(failsWith(formatGlb(meshes), {"A texture coordinate is not a number"}));
  }
}

TEST(GlbWriter, RefusesWhatDoesNotBelongTogether) {
  MeshRig meshes = withTargets(plane(3, 3));
  meshes.targets[0].positions.pop_back();
  EXPECT_TRUE(failsWith(formatGlb(meshes), {"at odds", "15 vertices, and the neutral 16"}));
  Rig rig = converted(withTargets(plane(3, 3)), 0.2);
  rig.targets[0].difference.clear();
  EXPECT_TRUE(failsWith(formatGlb(rig, {}), {"not decoded yet"}));
}

TEST_P(EveryFace, HoldsMeshesInSinglePrecision) {
  const MeshRig& source = GetParam().rig;
  const Result<std::string> bytes = formatGlb(source);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const Written glb(*bytes);
  EXPECT_FALSE(glb.primitive()["attributes"].contains("NORMAL"));
  std::vector<Vec3> neutral = glb.vectors(glb.attribute("POSITION"));
  neutral.resize(source.neutral.positions.size());  // the rest differ only in texture coordinates
  expectSingle(neutral, source.neutral.positions);
  for (std::size_t k = 0; k < source.targets.size(); ++k) {
    std::vector<Vec3> ways = glb.vectors(glb.morph(k)), expected = source.targets[k].positions;
    ways.resize(expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v) expected[v] -= source.neutral.positions[v];
    expectNear(ways, expected, 2 * largest(neutral) / (1 << 24));
  }
  EXPECT_EQ(glb.indices().size(), write(converted(source, 0.2)).indices().size());
}

TEST_P(EveryFace, HasTheSourcesTrianglesInTheirOrder) {
  const MeshRig& source = GetParam().rig;
  const Rig rig = converted(source, 0.2);
  const std::vector<Index> indices = write(rig).indices();
  // The triangles of every face run once around it: inner edges cancel.
  std::size_t at = 0;
  for (const Loop& face : loopsOf(source.neutral.polygons)) {
    std::multiset<std::pair<Index, Index>> edges;
    for (std::size_t k = 0; k < face.size() - 2; ++k, at += 3)
      for (int c = 0; c < 3; ++c) {
        const Index a = indices.at(at + c), b = indices.at(at + (c + 1) % 3);
        if (const auto back = edges.find({b, a}); back != edges.end())
          edges.erase(back);
        else
          edges.insert({a, b});
      }
    std::multiset<std::pair<Index, Index>> around;
    for (std::size_t k = 0; k < face.size(); ++k)
      around.insert({face[k], face[(k + 1) % face.size()]});
    EXPECT_EQ(edges, around);
  }
  EXPECT_EQ(at, indices.size());
}

TEST(GlbWriter, NamesWhatProgramsShow) {
  const Written glb = write(converted(sheetRig()));
  EXPECT_TRUE(glb.json["asset"]["generator"].get<std::string>().starts_with("sweepface 0."));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["nodes"][0]["name"], "face");
  EXPECT_EQ(glb.json["meshes"][0]["name"], "face");
  EXPECT_EQ(glb.json["meshes"][0]["extras"]["targetNames"], Json({"target1", "corner"}));
  EXPECT_EQ(glb.json["meshes"][0]["weights"], Json({0.0, 0.0}));
  EXPECT_EQ(glb.json["scenes"][0]["nodes"], Json::array({0}));
}

TEST(GlbWriter, HasUnitNormalsOfTheSurface) {
  const Rig rig = converted(sheetRig());
  const Written glb = write(rig);
  expectNear(glb.vectors(glb.attribute("NORMAL")), surfaceNormals(rig), 2e-7);
}

TEST(GlbWriter, TellsTheBoundsOfItsFloats) {
  const Written glb = write(converted(sheetRig()));
  std::set<std::size_t> positions{glb.attribute("POSITION"), glb.morph(0), glb.morph(1)};
  for (const std::size_t number : positions) {
    const std::vector<double> values = glb.stored(number);
    for (std::size_t c = 0; c < 3; ++c) {
      double low = values[c], high = values[c];
      for (std::size_t k = c; k < values.size(); k += 3)
        low = std::min(low, values[k]), high = std::max(high, values[k]);
      EXPECT_EQ(glb.accessor(number).at("min").at(c).get<double>(), low);
      EXPECT_EQ(glb.accessor(number).at("max").at(c).get<double>(), high);
    }
  }
}

TEST(GlbWriter, StoresTargetsSparselyWhereThatIsSmaller) {
  Rig rig = converted(withTargets(plane(40, 30), 2), 0.5);
  Target& still = rig.targets[1];
  std::ranges::fill(still.difference, Vec3{});
  still.difference[0] = {0, 0, 0.25};
  const Written glb = write(rig);
  EXPECT_FALSE(glb.isSparse(glb.morph(0)));
  ASSERT_TRUE(glb.isSparse(glb.morph(1)));
  const Json& sparse = glb.accessor(glb.morph(1)).at("sparse");
  EXPECT_LT(14 * sparse.at("count").get<std::size_t>(), 12u * 41 * 31);
  expectNear(glb.vectors(glb.morph(1)), surfaceDifference(rig, 1),
             2 * largest(surfacePositions(rig)) / (1 << 24));

  std::ranges::fill(still.difference, Vec3{});
  const Written stillness = write(rig);
  EXPECT_FALSE(stillness.hasData(stillness.morph(1)));
  EXPECT_EQ(stillness.vectors(stillness.morph(1)), std::vector<Vec3>(41 * 31));
}

TEST(GlbWriter, StoresSparseTargetsOfMoreVerticesThanSixteenBitsCount) {
  MeshRig source{plane(260, 260), {}};
  source.targets = {{"one", source.neutral.positions}};
  source.targets[0].positions[67'000].z += 1;
  const Written glb(formatGlb(source).value());
  ASSERT_TRUE(glb.isSparse(glb.morph(0)));
  EXPECT_EQ(glb.vectors(glb.morph(0))[67'000].z, 1);
}

TEST(GlbWriter, WritesNormalsOfTargetsOnRequest) {
  const Rig rig = converted(sheetRig());
  EXPECT_FALSE(write(rig).primitive()["targets"][0].contains("NORMAL"));
  const Written glb = write(rig, {.morphNormals = true});
  const std::vector<Vec3> base = glb.vectors(glb.attribute("NORMAL"));
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Vec3> normals = glb.vectors(glb.morph(k, "NORMAL"));
    for (std::size_t v = 0; v < normals.size(); ++v) normals[v] += base[v];
    expectNear(normals, surfaceNormals(rig, oneTarget(rig, k)), 4e-7);
  }
}

TEST(GlbWriter, ShowsTheWeightsItIsGiven) {
  const Written glb = write(converted(sheetRig()), {.weights = {0.25, -1.5}});
  EXPECT_EQ(glb.json["meshes"][0]["weights"], Json({0.25, -1.5}));
}

TEST(GlbWriter, WorksWithoutTargets) {
  const Written glb = write(converted(MeshRig{plane(4, 4), {}}));
  EXPECT_FALSE(glb.primitive().contains("targets"));
  EXPECT_FALSE(glb.json["meshes"][0].contains("weights"));
  EXPECT_FALSE(glb.json["meshes"][0].contains("extras"));
}

TEST(GlbWriter, KeepsLooseVertices) {
  MeshRig source = sheetRig();
  source.neutral.positions.push_back({7, 8, 9});
  source.targets[0].positions.push_back({7, 8, 9.5});
  source.targets[1].positions.push_back({7, 8, 9});
  const Written glb = write(converted(source));
  EXPECT_EQ(glb.vectors(glb.attribute("POSITION")).back(), (Vec3{7, 8, 9}));
  EXPECT_EQ(glb.vectors(glb.morph(0)).back(), (Vec3{0, 0, 0.5}));
  EXPECT_EQ(norm(glb.vectors(glb.attribute("NORMAL")).back()), 1);
}

// ---- Texture and materials ----

/// The sheet with a texture seam along its middle, and two materials.
MeshRig texturedRig() {
  MeshRig rig = sheetRig();
  Polygons& p = rig.neutral.polygons;
  for (Index f = 0; f < p.faceCount(); ++f) {
    const bool right = f % 8 >= 4;
    for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) {
      const Vec3& at = rig.neutral.positions[p.corners[c]];
      p.cornerTexcoords.push_back(static_cast<Index>(p.texcoords.size()));
      p.texcoords.push_back({at.x / 16 + (right ? 0.5 : 0), at.y / 8});
    }
    p.faceMaterial.push_back(right ? 1 : 0);
  }
  p.materials = {"left", "right", "unused"};
  return rig;
}

TEST(GlbWriter, HasAPrimitiveForEveryMaterial) {
  const Written glb = write(converted(texturedRig()));
  ASSERT_EQ(glb.json["meshes"][0]["primitives"].size(), 2u);
  ASSERT_EQ(glb.json["materials"].size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    const std::size_t material = glb.primitive(0, p).at("material");
    EXPECT_EQ(glb.json["materials"][material]["name"], p ? "right" : "left");
    EXPECT_EQ(glb.indices(0, p).size(), 3u * 2 * 4 * 6);
    EXPECT_EQ(glb.attribute("POSITION", 0, p), glb.attribute("POSITION", 0, 0));
    EXPECT_EQ(glb.morph(1, "POSITION", 0, p), glb.morph(1));
  }
}

TEST(GlbWriter, DoublesVerticesOnlyWhereTheTextureIsCut) {
  const MeshRig source = texturedRig();
  const Written glb = write(converted(source));
  const std::vector<double> texcoords = glb.numbers(glb.attribute("TEXCOORD_0"));
  ASSERT_EQ(texcoords.size(), 2u * (9 * 7 + 7));  // the seam has seven vertices
  std::map<std::pair<Index, bool>, std::array<double, 2>> expected;
  const Polygons& p = source.neutral.polygons;
  for (std::size_t primitive = 0; primitive < 2; ++primitive)
    for (const Index v : glb.indices(0, primitive)) {
      const Vec3 at = glb.vectors(glb.attribute("POSITION"))[v];
      EXPECT_NEAR(texcoords[2 * v], at.x / 16 + (primitive ? 0.5 : 0), 0.01);
      EXPECT_NEAR(texcoords[2 * v + 1], 1 - at.y / 8, 0.01);  // glTF counts from the top
    }
  EXPECT_EQ(p.texcoords.size(), 4u * 8 * 6);
}

/// Triangles around one vertex, which has a different texture coordinate in each.
MeshRig texturedFan(Index triangles) {
  MeshRig rig;
  Polygons& p = rig.neutral.polygons;
  rig.neutral.positions.push_back({});
  p.texcoords.push_back({});
  for (Index k = 0; k <= triangles; ++k) {
    const double angle = 6.0 * k / triangles;
    rig.neutral.positions.push_back({std::cos(angle), std::sin(angle), 0});
    p.texcoords.push_back({0.25 + 0.5 * k / triangles, 0.5});
  }
  p.faceStart = {0};
  for (Index k = 0; k < triangles; ++k) {
    p.corners.insert(p.corners.end(), {0, k + 1, k + 2});
    p.cornerTexcoords.insert(p.cornerTexcoords.end(), {k + 1, 0, 0});
    p.faceStart.push_back(3 * (k + 1));
    p.faceGroup.push_back(-1);
    p.faceMaterial.push_back(-1);
  }
  return rig;
}

TEST(GlbWriter, TakesVerticesOfVeryManyTextureCoordinates) {
  constexpr Index kTriangles = 250'000;
  const auto bytes = formatGlb(texturedFan(kTriangles));
  ASSERT_TRUE(bytes) << bytes.error().message;
  const Written glb(*bytes);
  const std::vector<Index> indices = glb.indices();
  ASSERT_EQ(indices.size(), 3u * kTriangles);
  std::size_t behind = kTriangles + 2;
  for (std::size_t k = 1; k < kTriangles; ++k)
    ASSERT_EQ(std::ranges::count(std::span(indices).subspan(3 * k, 3),
                                 static_cast<Index>(behind + k - 1)),
              1);
}

TEST(GlbWriter, KeepsCornersWithoutTexture) {
  MeshRig source = texturedRig();
  Polygons& p = source.neutral.polygons;
  for (std::size_t c = 0; c < p.cornerTexcoords.size(); c += 3) p.cornerTexcoords[c] = -1;
  const Written some = write(converted(source));
  EXPECT_EQ(some.accessor(some.attribute("TEXCOORD_0"))["count"],
            some.accessor(some.attribute("POSITION"))["count"]);
  std::ranges::fill(p.cornerTexcoords, -1);
  EXPECT_FALSE(write(converted(source)).primitive()["attributes"].contains("TEXCOORD_0"));

  // They get those of another corner, or 0, 1.
  MeshRig half{plane(2, 1), {}};
  half.neutral.polygons.texcoords = {{0.25, 0.5}, {1, 0.5}, {1, 0.75}, {0.25, 0.75}};
  half.neutral.polygons.cornerTexcoords = {-1, -1, -1, -1, 0, 1, 2, 3};
  const Written glb(formatGlb(half).value());
  EXPECT_EQ(glb.numbers(glb.attribute("TEXCOORD_0")),
            (std::vector<double>{0, 1, 0.25, 0.5, 1, 0.5, 0, 1, 0.25, 0.25, 1, 0.25}));
}

TEST(GlbWriter, WritesAnyName) {
  MeshRig source = texturedRig();
  source.targets[0].name = "smile \"wide\" \xC3\xA9\\";
  source.neutral.polygons.materials[0] = "sk\xE4n";  // Latin-1
  const Written glb = write(converted(source));
  EXPECT_EQ(glb.json["meshes"][0]["extras"]["targetNames"][0], source.targets[0].name);
  EXPECT_EQ(glb.json["materials"][0]["name"], "sk\xEF\xBF\xBDn");
}

TEST(GlbWriter, GivesAFaceWithoutPolygonsThoseOfItsSurface) {
  Rig rig = converted(MeshRig{dart(3), {}}, 0.2);
  const Written with = write(rig);
  rig.source = {};
  for (const Index lod : {0, 1}) {
    const Written glb = write(rig, {.lod = lod});
    EXPECT_EQ(glb.indices().size(), with.indices().size());
    EXPECT_EQ(glb.vectors(glb.attribute("POSITION")).size(),
              surfacePositions(converted(MeshRig{dart(3), {}}, 0.2)).size());
  }
}

// ---- Refusals ----

TEST(GlbWriter, RefusesWhatDoesNotGoTogether) {
  const Rig rig = converted(sheetRig());
  const auto refuses = [&](const GlbOptions& options, std::string_view why) {
    EXPECT_TRUE(failsWith(formatGlb(rig, options), {why}));
  };
  refuses({.weights = {1}}, "1 weights, but the face 2 targets");
  refuses({.weights = {1, 1e300}}, "not a number that a glTF can hold");
  refuses({.lod = -1}, "0 or more");
  for (const double tolerance : {-1e-3, std::nan(""), 1e9})
    refuses({.keyTolerance = tolerance}, "tolerance of keys");
  refuses({.lod = 30'000}, "4 GiB");
  const auto motion = Motion::make(std::vector{0.0}, std::vector{1.0}, TimeLaw::newton, 1);
  refuses({.motion = &*motion}, "1 weights, but the face 2 targets");
}

TEST(GlbWriter, RefusesNumbersBeyondFloats) {
  Rig rig = converted(sheetRig());
  rig.source.gridVertex.push_back(-1);
  rig.source.loose = {{1e300, 0, 0}};
  for (Target& target : rig.targets) target.looseDifference = {{}};
  EXPECT_TRUE(failsWith(formatGlb(rig, {}), {"single precision"}));
}

}  // namespace
}  // namespace sweepface
