// GLB files finer than their source.
#include <map>
#include <set>

#include "gltf/mix.hpp"
#include "gltf/placed_faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

class FinerFaces : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(LodWriter, FinerFaces, eachFace(), faceName);

TEST_P(FinerFaces, HaveTheSourcesTopologyWithoutCracks) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Topology source = topologyOf(weldedLoops(GetParam().rig));
  for (const Index lod : {1, 2, 5}) {
    Topology fine = topologyOf(weldedTriangles(write(rig, {.lod = lod})));
    fine.vertices = source.vertices;
    EXPECT_EQ(fine, source) << "level " << lod;
  }
}

TEST_P(FinerFaces, LieOnTheSurface) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Tessellation grid(rig.surface, 3);
  const auto pack = [](const Vec3& p) {
    return std::array{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  };
  for (std::size_t k = 0; k < rig.targets.size(); ++k) {
    const std::vector<Vec3> neutral = grid.positions(blend(rig, {}));
    const std::vector<Vec3> moved = grid.positions(blend(rig, oneTarget(rig, k)));
    std::map<std::array<float, 3>, Vec3> target;
    for (std::size_t v = 0; v < neutral.size(); ++v) target[pack(neutral[v])] = moved[v];
    const Written glb = write(rig, {.lod = 3});
    const std::vector<Vec3> positions = glb.vectors(glb.attribute("POSITION"));
    const std::vector<Vec3> deltas = glb.vectors(glb.morph(k));
    EXPECT_EQ(positions.size(), neutral.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const auto found = target.find(pack(positions[v]));
      ASSERT_NE(found, target.end());
      EXPECT_LE(norm(positions[v] + deltas[v] - found->second), 1e-6 * largest(moved));
    }
  }
}

// ---- Attributes ----

TEST(LodWriter, MixesTextureCoordinatesWithinQuads) {
  const Rig rig = converted(cutFace(), 0.001);
  const Written glb = write(rig, {.lod = 4});
  for (std::size_t p = 0; p < 2; ++p) {
    const std::vector<Vec2> at = placesIn(glb, p);
    const std::vector<Vec3> surface = glb.vectors(glb.attribute("POSITION", 0, p));
    const std::vector<double> t = glb.numbers(glb.attribute("TEXCOORD_0", 0, p));
    const std::vector<Index> indices = glb.indices(0, p);
    EXPECT_GE(indices.size(), 3u * 2 * 2 * 16);
    for (const Index v : indices) {
      EXPECT_TRUE(p == 0 ? at[v].x <= 1 : at[v].x >= 1);
      EXPECT_NEAR(t[2 * v], p == 0 ? at[v].x / 2 : at[v].y / 4 + 0.5, 1e-6);
      EXPECT_NEAR(t[2 * v + 1], p == 0 ? at[v].y / 2 : at[v].x / 4, 1e-6);
      EXPECT_NEAR(at[v].x, surface[v].x, 0.2);
      EXPECT_NEAR(at[v].y, surface[v].y, 0.2);
    }
  }
}

TEST(LodWriter, SharesVerticesBetweenPrimitives) {
  const Written glb = write(converted(cutFace()), {.lod = 4});
  EXPECT_EQ(glb.attribute("POSITION", 0, 0), glb.attribute("POSITION", 0, 1));
  EXPECT_EQ(topologyOf(weldedTriangles(glb)).boundaryLoops, 1);
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_EQ(glb.primitive(0, p)["material"], p) << "materials stay with their triangles";
}

/// Exporters double vertices for flat shading; the surface is smooth.
TEST(LodWriter, JoinsVerticesThatDifferInNormalsOnly) {
  Glb source = smallFace();
  std::vector<Vec3> positions, open, normals;
  std::vector<std::uint16_t> indices;
  for (const std::uint16_t v : sheetIndices()) {
    indices.push_back(static_cast<std::uint16_t>(positions.size()));
    positions.push_back(sheetPositions()[v]);
    open.push_back(openDeltas()[v]);
    normals.push_back(normalized({1.0 * static_cast<double>(positions.size()), 1, 5}));
  }
  const Json attributes{{"POSITION", source.addVectors(positions)},
                        {"NORMAL", source.addVectors(normals)}};
  source.primitive() = {
      {"attributes", attributes},
      {"indices", source.addIndices(indices)},
      {"targets", Json::array({Json::object({{"POSITION", source.addVectors(open)}})})}};
  const Written glb = write(converted(source), {.lod = 4});
  EXPECT_EQ(glb.vectors(glb.attribute("POSITION")).size(),
            static_cast<std::size_t>(Tessellation(converted(source).surface, 4).vertexCount()));
}

TEST(LodWriter, KeepsTypesOfColors) {
  Glb source = smallFace();
  std::vector<std::uint8_t> colors;
  for (const Vec3& p : sheetPositions())
    for (const double x : {100 * p.x, 100 * p.y, 50.0})
      colors.push_back(static_cast<std::uint8_t>(x));
  for (std::size_t v = 9; v-- > 0;) colors.insert(colors.begin() + 3 * v + 3, 0);  // padding
  source.primitive()["attributes"]["COLOR_0"] =
      source.addAccessor(source.addView(bytesOf(colors), 4), 5121, "VEC3", 9);
  source.attribute("COLOR_0")["normalized"] = true;
  addPlaces(source);
  const Written glb = write(converted(source, 0.001), {.lod = 4});
  const std::size_t color = glb.attribute("COLOR_0");
  EXPECT_EQ(glb.accessor(color)["componentType"], 5121);
  EXPECT_EQ(glb.accessor(color)["type"], "VEC3");
  EXPECT_EQ(glb.accessor(color)["normalized"], true);
  const std::vector<double> c = glb.stored(color);
  const std::vector<Vec2> at = placesIn(glb);
  for (std::size_t v = 0; v < at.size(); ++v) {
    EXPECT_NEAR(c[3 * v], 100 * at[v].x, 0.501);
    EXPECT_NEAR(c[3 * v + 1], 100 * at[v].y, 0.501);
    EXPECT_EQ(c[3 * v + 2], 50);
  }
}

TEST(LodWriter, KeepsTheBrightestColor) {
  Glb source = smallFace();
  source.primitive()["attributes"]["COLOR_0"] = source.addAccessor(
      source.addView(bytesOf(std::vector<std::uint16_t>(4 * 9, 65535)), 8), 5123, "VEC4", 9);
  source.attribute("COLOR_0")["normalized"] = true;
  for (Index lod = 2; lod <= 9; ++lod) {
    const Written glb = write(converted(source, 0.001), {.lod = lod});
    EXPECT_EQ(std::ranges::min(glb.stored(glb.attribute("COLOR_0"))), 65535) << lod;
  }
}

TEST(LodWriter, GivesWholeNumbersOfTheNearestVertex) {
  Glb source = smallFace();
  std::vector<float> numbers{7, 7, 7, 8, 8, 8, 9, 9, 9};
  source.primitive()["attributes"]["_WARMTH"] =
      source.addAccessor(source.addView(bytesOf(numbers)), 5126, "SCALAR", 9);
  std::vector<std::uint8_t> kinds;
  for (int v = 0; v < 9; ++v)
    kinds.insert(kinds.end(), {static_cast<std::uint8_t>(10 * (v / 3)), 0, 0, 0});
  source.primitive()["attributes"]["_KIND"] =
      source.addAccessor(source.addView(bytesOf(kinds), 4), 5121, "SCALAR", 9);
  addPlaces(source);
  const Written glb = write(converted(source, 0.001), {.lod = 4});
  const std::vector<Vec2> at = placesIn(glb);
  const std::vector<double> warmth = glb.numbers(glb.attribute("_WARMTH"));
  const std::vector<double> kind = glb.numbers(glb.attribute("_KIND"));
  for (std::size_t v = 0; v < at.size(); ++v) {
    EXPECT_NEAR(warmth[v], 7 + at[v].y, 1e-6);
    EXPECT_EQ(std::fmod(kind[v], 10), 0) << "nothing in between";
    EXPECT_LT(std::abs(kind[v] / 10 - at[v].y), 0.51);
  }
}

/// KHR_mesh_quantization has such, for materials with a transform.
TEST(LodWriter, MixesTextureCoordinatesThatAreWholeNumbers) {
  Glb source = smallFace();
  std::vector<std::uint16_t> texcoords;
  for (const Vec3& p : sheetPositions())
    for (const double x : {400 * p.x, 400 * p.y})
      texcoords.push_back(static_cast<std::uint16_t>(x));
  addPlaces(source);
  source.primitive()["attributes"]["TEXCOORD_2"] =
      source.addAccessor(source.addView(bytesOf(texcoords)), 5123, "VEC2", 9);
  const Written glb = write(converted(source, 0.001), {.lod = 4});
  const std::size_t accessor = glb.attribute("TEXCOORD_2");
  EXPECT_EQ(glb.accessor(accessor)["componentType"], 5123);
  const std::vector<double> t = glb.stored(accessor);
  const std::vector<Vec2> at = placesIn(glb);
  for (std::size_t v = 0; v < at.size(); ++v) {
    EXPECT_NEAR(t[2 * v], 400 * at[v].x, 0.501);
    EXPECT_NEAR(t[2 * v + 1], 400 * at[v].y, 0.501);
  }
}

TEST(LodWriter, LeavesOutWhatCountsOnTheOldVertices) {
  Glb source = smallFace();
  source.primitive()["extensions"] = {{"TEST_outline", {{"indices", 3}}},
                                      {"KHR_materials_variants", {{"mappings", Json::array()}}}};
  source.json["extensionsUsed"] = {"TEST_outline", "KHR_materials_variants"};
  source.primitive()["mode"] = 4;
  const Written glb = write(converted(source), {.lod = 2});
  EXPECT_FALSE(glb.primitive()["extensions"].contains("TEST_outline"));
  EXPECT_TRUE(glb.primitive()["extensions"].contains("KHR_materials_variants"));
  EXPECT_FALSE(glb.primitive().contains("mode"));
}

TEST(LodWriter, DropsTheBytesOfTheSource) {
  Glb source = smallFace();
  const Rig rig = converted(source);
  const Written fine = write(rig, {.lod = 1});
  std::size_t used = 0;
  for (const Json& view : fine.json["bufferViews"]) used += view["byteLength"].get<std::size_t>();
  EXPECT_LE(fine.binary.size(), used + 3 * fine.json["bufferViews"].size());
  std::set<std::size_t> named;
  for (const Json& accessor : fine.json["accessors"])
    if (accessor.contains("bufferView")) named.insert(accessor["bufferView"].get<std::size_t>());
  for (const Json& accessor : fine.json["accessors"])
    if (accessor.contains("sparse"))
      for (const char* part : {"indices", "values"})
        named.insert(accessor["sparse"][part]["bufferView"].get<std::size_t>());
  EXPECT_EQ(named.size(), fine.json["bufferViews"].size()) << "every view is of use";
}

TEST(LodWriter, KeepsTheBytesThatExtensionsMayName) {
  Glb source = smallFace();
  const std::size_t secret = source.addView("secret bytes");
  source.json["extensionsUsed"] = {"EXT_structural_metadata"};
  source.json["extensions"]["EXT_structural_metadata"] = {{"values", secret}};
  const std::size_t texcoords = source.attribute("TEXCOORD_0")["bufferView"];
  const Written fine = write(converted(source), {.lod = 2});
  const Json& kept = fine.json["bufferViews"].at(secret);
  EXPECT_EQ(fine.binary.substr(kept.value("byteOffset", 0), kept["byteLength"]), "secret bytes");
  EXPECT_EQ(fine.json["bufferViews"].at(texcoords)["byteLength"], 1) << "left to the face";
}

// ---- Skins ----

TEST(LodWriter, TiesNewVerticesToTheJointsOfTheirCorners) {
  for (const int component : {5126, 5121}) {
    const Written glb = write(converted(skinnedFace(component), 0.001), {.lod = 3});
    const auto joints = glb.stored(glb.attribute("JOINTS_0"));
    const auto weights = glb.numbers(glb.attribute("WEIGHTS_0"));
    const auto shares = glb.stored(glb.attribute("WEIGHTS_0"));
    const std::vector<Vec2> at = placesIn(glb);
    EXPECT_EQ(glb.accessor(glb.attribute("WEIGHTS_0"))["componentType"], component);
    ASSERT_EQ(joints.size(), 4 * at.size());
    for (std::size_t v = 0; v < at.size(); ++v) {
      double sum = 0, whole = 0, x = 0, y = 0, own = 0;
      std::set<double> known;
      for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
        sum += weights[k], whole += shares[k];
        if (weights[k] == 0) {
          EXPECT_EQ(joints[k], 0);
          continue;
        }
        EXPECT_TRUE(known.insert(joints[k]).second) << "a joint comes twice";
        if (joints[k] == 9) continue;
        x += weights[k] * std::fmod(joints[k], 3), y += weights[k] * std::floor(joints[k] / 3);
        own += weights[k];
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      EXPECT_NEAR(whole, component == 5121 ? 255 : 1, 1e-6);
      EXPECT_LE(known.size(), 4u);
      // Two corners of a quad and the common joint are among the strongest four; on edges of the
      // source, where no corner is lost, the joints' mean is the place itself.
      const auto isEdge = [](double c) { return c == std::round(c); };
      if (isEdge(at[v].x) || isEdge(at[v].y)) {
        EXPECT_NEAR(x / own, at[v].x, 0.01);
        EXPECT_NEAR(y / own, at[v].y, 0.01);
      }
    }
  }
}

TEST(LodWriter, KeepsTheJointsOfVerticesAsTheyWere) {
  const Written source(skinnedFace(5126).bytes());
  const Written glb = write(converted(skinnedFace(5126), 0.001), {.lod = 1});
  std::multiset<std::vector<double>> before, after;
  for (const auto& [from, into] : {std::pair{&source, &before}, std::pair{&glb, &after}}) {
    const auto joints = from->stored(from->attribute("JOINTS_0"));
    const auto weights = from->stored(from->attribute("WEIGHTS_0"));
    for (std::size_t v = 0; v < joints.size(); v += 4)
      into->insert(
          {joints[v], joints[v + 1], joints[v + 2], joints[v + 3], weights[v], weights[v + 1]});
  }
  EXPECT_EQ(after, before);
}

/// A skinned face of two primitives that share their vertices and the accessor of their joints.
/// The second one has only the common joint, 9.
Glb twiceSkinnedFace() {
  Glb glb = skinnedFace(5126);
  Json left = glb.primitive(), right = left;
  const std::vector<std::uint16_t> indices = sheetIndices();
  left["indices"] = glb.addIndices({indices.begin(), indices.begin() + 12});
  right["indices"] = glb.addIndices({indices.begin() + 12, indices.end()});
  std::vector<float> weights;
  for (int v = 0; v < 9; ++v)
    for (const float w : {0.f, 1.f, 0.f, 0.f}) weights.push_back(w);
  right["attributes"]["WEIGHTS_0"] =
      glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "VEC4", 9);
  glb.json["meshes"][0]["primitives"] = Json::array({left, right});
  return glb;
}

/// The smallest and the largest weight of a joint at any vertex of a primitive's triangles.
std::pair<double, double> shareOf(double joint, const Written& glb, std::size_t primitive) {
  const auto joints = glb.stored(glb.attribute("JOINTS_0", 0, primitive));
  const auto weights = glb.stored(glb.attribute("WEIGHTS_0", 0, primitive));
  std::pair<double, double> range{2, -1};
  for (const Index v : glb.indices(0, primitive)) {
    double share = 0;
    for (std::size_t k = 4 * static_cast<std::size_t>(v), end = k + 4; k < end; ++k)
      if (joints.at(k) == joint) share += weights.at(k);
    range = {std::min(range.first, share), std::max(range.second, share)};
  }
  return range;
}

TEST(LodWriter, MixesJointsThatPrimitivesShareWithTheWeightsOfEach) {
  const Written glb = write(converted(twiceSkinnedFace(), 0.001), {.lod = 3});
  for (const std::size_t primitive : {0, 1}) expectWhole(glb, primitive);
  EXPECT_NEAR(shareOf(9, glb, 1).first, 1, 1e-6);
  EXPECT_LT(shareOf(9, glb, 0).second, 0.9);
  EXPECT_GT(shareOf(9, glb, 0).first, 0.3);
}

TEST(LodWriter, MixesASecondSetOfJointsThatOnePrimitiveAloneHas) {
  Glb source = twiceSkinnedFace();
  const Json left = source.primitive()["attributes"];
  Json& right = source.primitive(0, 1)["attributes"];
  const Json second = right["WEIGHTS_0"];
  right["WEIGHTS_0"] = left["WEIGHTS_0"];
  right["JOINTS_1"] = left["JOINTS_0"];
  right["WEIGHTS_1"] = second;
  const Written glb = write(converted(source, 0.001), {.lod = 3});
  for (const std::size_t primitive : {0, 1}) expectWhole(glb, primitive);
  EXPECT_TRUE(glb.primitive(0, 1)["attributes"].contains("JOINTS_1"));
  EXPECT_LT(shareOf(9, glb, 0).second, 0.9);
}

TEST(LodWriter, LeavesOutJointsWithoutWeights) {
  Glb source = skinnedFace(5126);
  Json& attributes = source.primitive()["attributes"];
  const Json joints = attributes["JOINTS_0"], weights = attributes["WEIGHTS_0"];
  attributes["JOINTS_1"] = joints;
  attributes["WEIGHTS_2"] = weights;
  const Written glb = write(converted(source, 0.001), {.lod = 3});
  expectWhole(glb, 0);
  EXPECT_TRUE(glb.primitive()["attributes"].contains("JOINTS_0"));
  EXPECT_FALSE(glb.primitive()["attributes"].contains("JOINTS_1"));
  EXPECT_FALSE(glb.primitive()["attributes"].contains("WEIGHTS_2"));
}

TEST(LodWriter, LeavesOutJointsAndWeightsOfTargets) {
  Glb source = skinnedFace(5126);
  const Json weights = source.primitive()["attributes"]["WEIGHTS_0"];
  source.primitive()["targets"][0]["WEIGHTS_0"] = weights;
  const Written glb = write(converted(source, 0.001), {.lod = 3});
  EXPECT_TRUE(glb.primitive()["targets"][0].contains("POSITION"));
  EXPECT_FALSE(glb.primitive()["targets"][0].contains("WEIGHTS_0"));
}

// ---- Mixtures ----

TEST(Mix, IsTheSameFromBothEndsOfAnEdge) {
  for (Index step = 0; step <= 5; ++step) {
    const gltf::Mix a = gltf::Mix::between(3, 8, step, 5),
                    b = gltf::Mix::between(8, 3, 5 - step, 5);
    EXPECT_EQ(a.corners, b.corners);
    EXPECT_EQ(a.weights(), b.weights());
  }
  EXPECT_TRUE(gltf::Mix::between(3, 8, 5, 5).isVertex());
  EXPECT_EQ(gltf::Mix::between(3, 8, 5, 5).corners[0], 8);
  EXPECT_EQ(gltf::Mix::between(4, 4, 2, 5).weights()[0], 1);
}

}  // namespace
}  // namespace sweepface
