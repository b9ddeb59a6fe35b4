// GLB files of a budget that go back into the scene that their face came with.
#include <map>
#include <ranges>
#include <set>

#include "gltf/placed_faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// How long edges may be: the sheet's own are one unit long.
constexpr double kCoarse = 100, kFine = 0.3;

/// The rig of a sheet that is one patch, seams and all.
Rig inOnePatch(const Glb& glb) { return converted(glb, 0.5); }

/// Holds the rig, as the tessellation points into its surface.
struct Budgeted {
  Budgeted(Rig given, double length)
      : rig(std::move(given)),
        grid(rig.surface,
             densityFor(rig.surface, blend(rig, {}), {Budget::Kind::edgeLength, length}).value()) {}
  Budgeted(const Budgeted&) = delete;

  Written written(GlbOptions options = {}) const {
    options.grid = &grid;
    return write(rig, options);
  }

  Rig rig;
  Tessellation grid;
};

std::set<std::array<float, 3>> asSet(const std::vector<Vec3>& positions) {
  std::set<std::array<float, 3>> set;
  for (const Vec3& p : positions)
    set.insert({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return set;
}

class FacesInScenes : public ::testing::TestWithParam<Face> {
 protected:
  /// The face with the scene of the GLB that its meshes make.
  static Rig inScene() {
    const Result<std::string> bytes = formatGlb(GetParam().rig);
    if (!bytes) return ADD_FAILURE() << bytes.error().message, Rig{};
    Result<RigSource> source = parseGltf(*bytes, "face.glb", {});
    if (!source) return ADD_FAILURE() << source.error().message, Rig{};
    Rig rig = converted(source->rig, 0.2);
    rig.scene = std::move(source->scene);
    return rig;
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetWriter, FacesInScenes, eachFace(), faceName);

TEST_P(FacesInScenes, HaveTheTrianglesOfTheTessellation) {
  for (const double length : {100.0, 0.7}) {
    const Budgeted face(inScene(), length);
    const Written glb = face.written();
    const std::vector<Loop> triangles = weldedTriangles(glb);
    EXPECT_EQ(triangles.size(), face.grid.triangles().size());
    std::vector<Loop> expected;
    for (const auto& [a, b, c] : face.grid.triangles()) expected.push_back({a, b, c});
    EXPECT_EQ(topologyOf(triangles).boundaryLoops, topologyOf(expected).boundaryLoops);
    EXPECT_EQ(asSet(glb.vectors(glb.attribute("POSITION"))),
              asSet(face.grid.positions(blend(face.rig, {}))));
  }
}

TEST_P(FacesInScenes, MoveAsTheSurfaceDoes) {
  const Budgeted face(inScene(), 0.7);
  const Written glb = face.written({.morphNormals = true});
  const std::vector<Vec3> positions = glb.vectors(glb.attribute("POSITION")),
                          normals = glb.vectors(glb.attribute("NORMAL"));
  for (std::size_t k = 0; k < face.rig.targets.size(); ++k) {
    const std::vector<Vec3> moves = glb.vectors(glb.morph(k)),
                            turns = glb.vectors(glb.morph(k, "NORMAL"));
    const std::vector<Vec3> vectors = blend(face.rig, oneTarget(face.rig, k)),
                            expected = face.grid.positions(vectors),
                            directions = face.grid.normals(vectors);
    const double near = 1e-6 * largest(expected);
    for (std::size_t v = 0; v < moves.size(); ++v) {
      const Vec3 p = positions[v] + moves[v], n = normals[v] + turns[v];
      const auto isThere = [&](std::size_t q) {
        return norm(p - expected[q]) <= near && norm(n - directions[q]) <= 1e-6;
      };
      EXPECT_TRUE(std::ranges::any_of(std::views::iota(std::size_t{0}, expected.size()), isThere))
          << "vertex " << v;
    }
  }
}

TEST(BudgetWriter, MixesTextureCoordinatesAndContinuesThemBeyondSeams) {
  for (const double length : {kCoarse, kFine}) {
    const Written glb = Budgeted(inOnePatch(cutFace()), length).written();
    for (std::size_t p = 0; p < 2; ++p) {
      expectWhole(glb, p);
      const std::vector<Vec2> at = placesIn(glb, p);
      const std::vector<Vec3> surface = glb.vectors(glb.attribute("POSITION", 0, p));
      const std::vector<double> t = glb.numbers(glb.attribute("TEXCOORD_0", 0, p));
      for (const Index v : glb.indices(0, p)) {
        EXPECT_NEAR(t[2 * v], p == 0 ? at[v].x / 2 : at[v].y / 4 + 0.5, 1e-6);
        EXPECT_NEAR(t[2 * v + 1], p == 0 ? at[v].y / 2 : at[v].x / 4, 1e-6);
        EXPECT_NEAR(at[v].x, surface[v].x, 0.2);
        EXPECT_NEAR(at[v].y, surface[v].y, 0.2);
      }
    }
  }
}

/// The small face with a seam down its middle, whose vertices are there twice. Joint 1 moves it
/// more and more from x = 0 to 2.
Glb seamedFace() {
  Glb glb = smallFace();
  std::vector<Vec3> positions, deltas;
  std::vector<Vec2> texcoords, places;
  std::vector<float> weights;
  std::vector<std::uint16_t> indices;
  for (const bool right : {false, true}) {
    const auto first = static_cast<int>(positions.size());
    for (int v = 0; v < 9; ++v) {
      const Vec3 p = sheetPositions()[v];
      positions.push_back(p), deltas.push_back(openDeltas()[v]), places.push_back({p.x, p.y});
      texcoords.push_back(right ? Vec2{p.y / 4 + 0.5, p.x / 4} : Vec2{p.x / 2, p.y / 2});
      for (const double w : {1 - p.x / 2, p.x / 2, 0.0, 0.0})
        weights.push_back(static_cast<float>(w));
    }
    for (std::size_t k = 0; k < sheetIndices().size(); ++k)
      if (k / 6 % 2 == right)
        indices.push_back(static_cast<std::uint16_t>(first + sheetIndices()[k]));
  }
  std::vector<std::uint8_t> joints;
  for (int v = 0; v < 18; ++v) joints.insert(joints.end(), {0, 1, 0, 0});
  const Json attributes{
      {"POSITION", glb.addVectors(positions)},
      {"TEXCOORD_0", glb.addTexcoords(texcoords)},
      {"TEXCOORD_1", glb.addTexcoords(places)},
      {"JOINTS_0", glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 18)},
      {"WEIGHTS_0", glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "VEC4", 18)}};
  glb.primitive() = {
      {"attributes", attributes},
      {"indices", glb.addIndices(indices)},
      {"targets", Json::array({Json::object({{"POSITION", glb.addVectors(deltas)}})})}};
  return glb;
}

TEST(BudgetWriter, SeesTrianglesFromOneSideOfASeam) {
  for (const double length : {kCoarse, kFine}) {
    const Written glb = Budgeted(inOnePatch(seamedFace()), length).written();
    const std::vector<double> t = glb.numbers(glb.attribute("TEXCOORD_0")),
                              weights = glb.numbers(glb.attribute("WEIGHTS_0")),
                              joints = glb.stored(glb.attribute("JOINTS_0"));
    const std::vector<Vec2> at = placesIn(glb);
    const std::vector<Index> indices = glb.indices();
    int beyond = 0;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      const auto isOn = [&](bool right) {
        return std::ranges::all_of(std::span(indices).subspan(k, 3), [&](Index v) {
          const Vec2 expected =
              right ? Vec2{at[v].y / 4 + 0.5, at[v].x / 4} : Vec2{at[v].x / 2, at[v].y / 2};
          return std::hypot(t[2 * v] - expected.x, t[2 * v + 1] - expected.y) < 1e-6;
        });
      };
      const bool right = isOn(true);
      EXPECT_NE(right, isOn(false));
      for (std::size_t c = k; c < k + 3; ++c) {
        const Index v = indices[c];
        beyond += right ? at[v].x < 1 : at[v].x > 1;
        double share = 0;
        for (std::size_t j = 4 * static_cast<std::size_t>(v), end = j + 4; j < end; ++j)
          if (joints[j] == 1) share += weights[j];
        EXPECT_NEAR(share, at[v].x / 2, 1e-6) << "only texture coordinates know of the seam";
      }
    }
    EXPECT_GT(beyond, 0);
  }
}

TEST(BudgetWriter, SharesVerticesWhereNoSeamIs) {
  Glb source = smallFace();
  addPlaces(source);
  for (const double length : {kCoarse, kFine}) {
    const Budgeted face(inOnePatch(source), length);
    const Written glb = face.written();
    EXPECT_EQ(glb.accessor(glb.attribute("POSITION"))["count"], face.grid.vertexCount());
    EXPECT_EQ(glb.primitive()["material"], 0);
  }
}

TEST(BudgetWriter, HasColorsOfThePlaceAlsoBeyondSeams) {
  Glb source = cutFace();
  std::vector<Vec3> colors;
  for (const Vec3& p : sheetPositions()) colors.push_back({p.x / 2, p.y / 2, 1});
  for (std::size_t p = 0; p < 2; ++p)
    source.primitive(0, p)["attributes"]["COLOR_0"] = source.addVectors(colors);
  const Written glb = Budgeted(inOnePatch(source), kCoarse).written();
  int beyond = 0;
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<Vec3> found = glb.vectors(glb.attribute("COLOR_0", 0, p));
    const std::vector<Vec2> at = placesIn(glb, p);
    for (const Index v : glb.indices(0, p)) {
      beyond += p == 0 ? at[v].x > 1 : at[v].x < 1;
      EXPECT_LE(norm(found[v] - Vec3{at[v].x / 2, at[v].y / 2, 1}), 1e-6);
    }
  }
  EXPECT_GT(beyond, 0) << "some triangle reaches beyond the seam";
}

/// What a vertex is bound to, by its place. Expects copies at one place to be bound alike.
using Bonds = std::map<std::array<double, 3>, std::map<double, double>>;
void addBonds(Bonds& bonds, const Written& glb, std::size_t primitive) {
  const std::vector<Vec3> positions = glb.vectors(glb.attribute("POSITION", 0, primitive));
  const auto joints = glb.stored(glb.attribute("JOINTS_0", 0, primitive));
  const auto weights = glb.numbers(glb.attribute("WEIGHTS_0", 0, primitive));
  for (const Index v : glb.indices(0, primitive)) {
    std::map<double, double> own;
    for (std::size_t k = 4 * static_cast<std::size_t>(v), end = k + 4; k < end; ++k)
      if (weights[k] > 0) own[joints[k]] += weights[k];
    const Vec3& p = positions[v];
    const auto [known, isNew] = bonds.emplace(std::array{p.x, p.y, p.z}, own);
    EXPECT_TRUE(isNew || known->second == own) << p.x << ' ' << p.y;
  }
}

TEST(BudgetWriter, BindsCopiesAlikeInAllPrimitives) {
  for (const bool apart : {false, true})
    for (const double length : {kCoarse, kFine}) {
      Glb source = skinnedFace(5126);
      Json left = source.primitive(), right = left;
      std::vector<std::uint16_t> all = sheetIndices(), first, second;
      for (std::size_t k = 0; k < all.size(); ++k)
        (k / 6 % 2 == 0 ? first : second).push_back(all[k]);
      left["indices"] = source.addIndices(first), right["indices"] = source.addIndices(second);
      if (apart) right["attributes"]["POSITION"] = source.addVectors(sheetPositions());
      source.json["meshes"][0]["primitives"] = Json::array({left, right});
      const Written glb = Budgeted(inOnePatch(source), length).written();
      Bonds bonds;
      for (std::size_t p = 0; p < 2; ++p) {
        expectWhole(glb, p);
        addBonds(bonds, glb, p);
      }
      EXPECT_GE(bonds.size(), 4u);
    }
}

TEST(BudgetWriter, TiesVerticesToTheJointsWhereTheyLie) {
  for (const double length : {kCoarse, kFine}) {
    const Written glb = Budgeted(inOnePatch(skinnedFace(5126)), length).written();
    expectWhole(glb, 0);
    const auto joints = glb.stored(glb.attribute("JOINTS_0"));
    const auto weights = glb.numbers(glb.attribute("WEIGHTS_0"));
    const std::vector<Vec2> at = placesIn(glb);
    for (std::size_t v = 0; v < at.size(); ++v) {
      double sum = 0, common = 0, own = 0, x = 0;
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        sum += weights[k];
        if (joints[k] == 9) common += weights[k];
        if (joints[k] < 9) own += weights[k], x += weights[k] * std::fmod(joints[k], 3);
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      EXPECT_GT(common, 0.39);
      if (at[v].x == std::round(at[v].x)) {
        EXPECT_NEAR(x / own, at[v].x, 0.01);
      }
    }
  }
}

class LostPrimitives : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BudgetWriter, LostPrimitives, ::testing::Bool());

TEST_P(LostPrimitives, ShowAPoint) {
  Glb source = smallFace();
  const std::vector<std::uint16_t> all = sheetIndices();
  std::vector<std::uint16_t> diagonal, rest;
  for (std::size_t k = 0; k < all.size(); ++k)
    (k / 6 == 0 || k / 6 == 3 ? diagonal : rest).push_back(all[k]);
  Json first = source.primitive(), second = first;
  first["indices"] = source.addIndices(diagonal), second["indices"] = source.addIndices(rest);
  if (GetParam())  // vertices of its own
    second["attributes"]["POSITION"] = source.addVectors(sheetPositions());
  source.json["meshes"][0]["primitives"] = Json::array({first, second});
  const Written glb = Budgeted(inOnePatch(source), kCoarse).written();
  std::multiset<std::size_t> counts;
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<Index> indices = glb.indices(0, p);
    counts.insert(std::set<Index>(indices.begin(), indices.end()).size());
    EXPECT_GT(glb.accessor(glb.attribute("POSITION", 0, p))["count"], std::ranges::max(indices));
  }
  EXPECT_EQ(counts, (std::multiset<std::size_t>{1, 6}))
      << "one of them shows a point, the other both triangles, as a seam parts them";
}

TEST(BudgetWriter, TurnsTrianglesOverWhereTheNodeMirrors) {
  Glb source = smallFace();
  source.json["nodes"][0]["scale"] = {-1, 1, 1};
  for (const double length : {kCoarse, kFine}) {
    const Written glb = Budgeted(inOnePatch(source), length).written();
    const std::vector<Vec3> p = glb.vectors(glb.attribute("POSITION"));
    const std::vector<Index> t = glb.indices();
    for (std::size_t k = 0; k < t.size(); k += 3)
      EXPECT_GT(cross(p[t[k + 1]] - p[t[k]], p[t[k + 2]] - p[t[k]]).z, 0);
  }
}

TEST(BudgetWriter, LeavesTheRestOfTheSceneAlone) {
  Glb source = skinnedFace(5126);
  source.json["nodes"][0]["extras"] = {{"kept", true}};
  const Budgeted face(inOnePatch(source), kFine);
  const Written glb = face.written({.quantize = true, .weights = {0.25, 0}});
  EXPECT_EQ(glb.json["skins"][0]["joints"], source.json["skins"][0]["joints"]);
  EXPECT_EQ(glb.json["nodes"][0]["extras"]["kept"], true);
  EXPECT_EQ(glb.json["meshes"][0]["weights"], Json({0.25, 0}));
  EXPECT_EQ(glb.accessor(glb.attribute("POSITION"))["componentType"], 5122);
}

/// Without its order or quads a face cannot go back, and is written as one without a scene.
TEST(BudgetWriter, LeavesOutASceneThatDoesNotKnowItsVertices) {
  Rig rig = inOnePatch(cutFace());
  rig.source.quadCorners.clear();
  const Written glb = Budgeted(std::move(rig), kFine).written();
  EXPECT_EQ(glb.json["nodes"][0]["name"], "face");
}

}  // namespace
}  // namespace sweepface
