// GLB files of faces that came with a scene.
#include <functional>
#include <set>

#include "sweepface/strip.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// Accessors of the rig: positions and normals, of the base and of the targets.
std::set<std::size_t> ownAccessors(const Json& json) {
  std::set<std::size_t> own;
  const auto add = [&](const Json& attributes) {
    for (const char* name : {"POSITION", "NORMAL"})
      if (attributes.contains(name)) own.insert(attributes[name].get<std::size_t>());
  };
  for (const Json& mesh : json["meshes"])
    for (const Json& primitive : mesh["primitives"]) {
      add(primitive["attributes"]);
      if (primitive.contains("targets"))
        for (const Json& target : primitive["targets"]) add(target);
    }
  return own;
}

/// The small face with more of everything around it.
Glb richFace() {
  Glb glb = smallFace();
  Json& attributes = glb.primitive()["attributes"];
  std::vector<std::uint8_t> colors, joints;
  std::vector<float> weights, times{0, 1, 2}, moves(9, 0.5f);
  for (int v = 0; v < 9; ++v)
    for (int k = 0; k < 4; ++k) {
      colors.push_back(static_cast<std::uint8_t>(20 * v + k));
      joints.push_back(static_cast<std::uint8_t>(k < 2 ? k : 0));
      weights.push_back(k < 2 ? 0.5f : 0.0f);
    }
  attributes["COLOR_0"] = glb.addAccessor(glb.addView(bytesOf(colors)), 5121, "VEC4", 9);
  glb.attribute("COLOR_0")["normalized"] = true;
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  attributes["WEIGHTS_0"] = glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "VEC4", 9);
  glb.primitive()["extensions"]["TEST_unknown"] = {{"kept", true}};
  glb.add("images", {{"bufferView", glb.addView("\x89PNG not really")}, {"mimeType", "image/png"}});
  glb.add("nodes", {{"name", "camera"}, {"camera", 0}});
  glb.add("nodes", {{"name", "hip"}, {"children", {3}}});
  glb.add("nodes", {{"name", "spine"}});
  glb.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.75}, {"znear", 0.1}}}});
  glb.add("skins", {{"joints", {2, 3}}});
  glb.json["nodes"][0]["skin"] = 0;
  glb.json["scene"] = 0;
  glb.add("scenes", {{"nodes", {0, 1, 2}}});
  const std::size_t input = glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", 3);
  const std::size_t output = glb.addAccessor(glb.addView(bytesOf(moves)), 5126, "VEC3", 3);
  glb.add("animations",
          {{"name", "nod"},
           {"samplers", Json::array({{{"input", input}, {"output", output}}})},
           {"channels",
            Json::array({{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}})}});
  glb.json["extensionsUsed"] = {"TEST_unknown"};
  glb.json["extras"] = {{"author", "nobody"}};
  return glb;
}

TEST(SceneWriter, ChangesNothingButTheSurface) {
  const Glb source = richFace();
  const Rig rig = converted(source);
  const Written before(source.bytes()), after = write(rig);
  for (const auto& [key, value] : before.json.items()) {
    if (key == "accessors" || key == "bufferViews" || key == "buffers" || key == "asset" ||
        key == "images")
      continue;
    EXPECT_EQ(after.json.at(key), value) << key;
  }
  const auto bytesOfImage = [](const Written& glb) {
    const Json& view =
        glb.json["bufferViews"][glb.json["images"][0]["bufferView"].get<std::size_t>()];
    return glb.binary.substr(view["byteOffset"], view["byteLength"]);
  };
  EXPECT_EQ(bytesOfImage(after), bytesOfImage(before));
  const std::set<std::size_t> own = ownAccessors(before.json);
  ASSERT_EQ(after.json["accessors"].size(), before.json["accessors"].size());
  for (std::size_t a = 0; a < after.json["accessors"].size(); ++a) {
    if (own.contains(a)) continue;
    for (const char* key : {"componentType", "count", "type"})
      EXPECT_EQ(after.accessor(a)[key], before.accessor(a)[key]);
    EXPECT_EQ(after.raw(a), before.raw(a)) << "accessor " << a;
  }
}

TEST(SceneWriter, FillsPositionsNormalsAndTargets) {
  const Rig rig = converted(richFace());
  const Written glb = write(rig);
  const std::vector<Vec3> neutral = surfacePositions(rig);
  expectSingle(glb.vectors(glb.attribute("POSITION")), neutral);
  expectNear(glb.vectors(glb.attribute("NORMAL")), surfaceNormals(rig), 2e-7);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Vec3> moved = glb.vectors(glb.morph(k));
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += neutral[v];
    expectSingle(moved, surfacePositions(rig, oneTarget(rig, k)));
  }
}

TEST(SceneWriter, ReadsBackAsTheSurface) {
  Glb source = richFace();
  source.json["nodes"][0] = {{"mesh", 0}, {"rotation", {0.5, 0.5, 0.5, 0.5}}, {"scale", {1, 2, 3}}};
  const Rig rig = converted(source);
  const auto bytes = formatGlb(rig, {});
  ASSERT_TRUE(bytes.has_value()) << bytes.error().message;
  const auto again = parseGltf(*bytes, "again.glb", {});
  ASSERT_TRUE(again.has_value()) << again.error().message;
  expectNear(again->rig.neutral.positions, surfacePositions(rig), 1e-6);
  ASSERT_EQ(again->rig.targets.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    expectNear(again->rig.targets[k].positions, surfacePositions(rig, oneTarget(rig, k)), 1e-6);
  EXPECT_EQ(again->rig.neutral.polygons.corners, rig.source.polygons.corners);
}

// ---- Transforms ----

using Matrix = std::array<double, 16>;  // column-major

Vec3 transformed(const Matrix& m, const Vec3& p, double w = 1) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12] * w,
          m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13] * w,
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14] * w};
}

/// Expects the written mesh to be where the surface is in the scene, with normals at right angles
/// to it.
void expectInScene(const Rig& rig, const Written& glb, const Matrix& matrix) {
  const auto placed = [&](std::vector<Vec3> list, double w) {
    for (Vec3& p : list) p = transformed(matrix, p, w);
    return list;
  };
  const double close = 1e-5;
  expectNear(placed(glb.vectors(glb.attribute("POSITION")), 1), surfacePositions(rig), close);
  for (std::size_t k = 0; k < rig.targets.size(); ++k) {
    std::vector<Vec3> expected = surfacePositions(rig, oneTarget(rig, k));
    const std::vector<Vec3> neutral = surfacePositions(rig);
    for (std::size_t v = 0; v < expected.size(); ++v) expected[v] -= neutral[v];
    expectNear(placed(glb.vectors(glb.morph(k)), 0), expected, close);
  }
  // What is at right angles to a normal in the mesh is so in the scene.
  const std::vector<Vec3> normals = glb.vectors(glb.attribute("NORMAL"));
  const std::vector<Vec3> expected = surfaceNormals(rig);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(norm(normals[v]), 1, 1e-6);
    const Vec3 side = cross(normals[v], {0.3, 0.5, 0.8}), other = cross(normals[v], side);
    EXPECT_NEAR(dot(normalized(transformed(matrix, side, 0)), expected[v]), 0, 1e-5);
    EXPECT_NEAR(dot(normalized(transformed(matrix, other, 0)), expected[v]), 0, 1e-5);
  }
}

/// Expects triangles to wind counter-clockwise around the normals. In a scene that mirrors the mesh
/// they wind clockwise, as they must.
void expectOutwards(const Written& glb) {
  const std::vector<Vec3> p = glb.vectors(glb.attribute("POSITION"));
  const std::vector<Vec3> n = glb.vectors(glb.attribute("NORMAL"));
  const std::vector<Index> t = glb.indices();
  for (std::size_t k = 0; k < t.size(); k += 3)
    EXPECT_GT(dot(cross(p[t[k + 1]] - p[t[k]], p[t[k + 2]] - p[t[k]]), n[t[k]]), 0);
}

struct Placement {
  const char* name;
  Json node;
  Matrix matrix;
};

class Placements : public ::testing::TestWithParam<Placement> {};
INSTANTIATE_TEST_SUITE_P(
    SceneWriter, Placements,
    ::testing::Values(
        Placement{"identity", Json::object(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        Placement{"moved",
                  {{"translation", {5, -3, 2}}},
                  {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, -3, 2, 1}},
        // A third of a turn around the diagonal: x becomes y, y becomes z.
        Placement{"turned",
                  {{"rotation", {0.5, 0.5, 0.5, 0.5}}, {"scale", {2, 3, 4}}},
                  {0, 2, 0, 0, 0, 0, 3, 0, 4, 0, 0, 0, 0, 0, 0, 1}},
        Placement{
            "mirrored", {{"scale", {-1, 1, 1}}}, {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
        Placement{"sheared",
                  {{"matrix", {1, 0.5, 0, 0, 0, 2, 0.25, 0, 0.5, 0, -1, 0, 7, 8, 9, 1}}},
                  {1, 0.5, 0, 0, 0, 2, 0.25, 0, 0.5, 0, -1, 0, 7, 8, 9, 1}}),
    [](const auto& placement) { return placement.param.name; });

TEST_P(Placements, AreUndone) {
  Glb source = smallFace();
  source.json["nodes"][0].update(GetParam().node);
  const Rig rig = converted(source);
  for (const Index lod : {0, 1}) {
    SCOPED_TRACE(lod);
    const Written glb = write(rig, {.lod = lod});
    if (lod == 0) expectInScene(rig, glb, GetParam().matrix);
    expectOutwards(glb);
  }
}

TEST(SceneWriter, FollowsNodesDownToTheMesh) {
  Glb source = smallFace();
  source.json["nodes"][0]["translation"] = {1, 2, 3};
  source.add("nodes", {{"scale", {10, 10, 10}}, {"translation", {0, 0, 1}}, {"children", {0}}});
  const Rig rig = converted(source, 0.5);
  expectInScene(rig, write(rig), {10, 0, 0, 0, 0, 10, 0, 0, 0, 0, 10, 0, 10, 20, 31, 1});
}

TEST(SceneWriter, LeavesSkinnedMeshesWhereTheirNodesAreNot) {
  Glb source = richFace();
  source.json["nodes"][0]["translation"] = {100, 0, 0};
  const Rig rig = converted(source);
  expectSingle(write(rig).vectors(write(rig).attribute("POSITION")), surfacePositions(rig));
}

/// A file may hold a scene although the vertex order was left out; the scene's vertices then
/// differ.
TEST(SceneWriter, LeavesOutASceneWhoseOrderIsNotKnown) {
  Rig rig = converted(richFace());
  const std::string scene = rig.scene;
  ASSERT_TRUE(strip(rig, {.order = true}));
  rig.scene = scene;
  for (const Index lod : {0, 2}) {
    const Written glb = write(rig, {.lod = lod});
    EXPECT_EQ(glb.json["nodes"], Json::array({{{"name", "face"}, {"mesh", 0}}}));
    EXPECT_FALSE(glb.json.contains("skins"));
    expectOutwards(glb);
    if (lod == 0) expectSingle(glb.vectors(glb.attribute("POSITION")), surfacePositions(rig));
  }
}

// ---- Several meshes ----

/// Two meshes: a head with "open" and "wink", and eyes beside it with "look" and "open".
Glb headAndEyes() {
  Glb glb = smallFace();
  std::vector<Vec3> eyes = sheetPositions(), look(9, Vec3{0, 0.5, 0}), open(9, Vec3{0, 0, 0.25});
  for (Vec3& p : eyes) p.x += 5;
  Json primitive = {{"attributes", {{"POSITION", glb.addVectors(eyes)}}},
                    {"indices", glb.addIndices(sheetIndices())},
                    {"targets", Json::array({Json::object({{"POSITION", glb.addVectors(look)}}),
                                             Json::object({{"POSITION", glb.addVectors(open)}})})}};
  glb.add("meshes", {{"name", "eyes"},
                     {"primitives", Json::array({std::move(primitive)})},
                     {"extras", {{"targetNames", {"look", "open"}}}},
                     {"weights", {0.5, 0.0}}});
  glb.add("nodes", {{"mesh", 1}, {"weights", {0.0, 0.25}}});
  return glb;
}

TEST(SceneWriter, GivesEveryMeshItsOwnTargets) {
  const Rig rig = converted(headAndEyes(), 0.01);
  ASSERT_EQ(rig.targets.size(), 3u);
  const Written glb = write(rig);
  expectNear(glb.vectors(glb.morph(0, "POSITION", 1)), std::vector<Vec3>(9, {0, 0.5, 0}), 0.02);
  expectNear(glb.vectors(glb.morph(1, "POSITION", 1)), std::vector<Vec3>(9, {0, 0, 0.25}), 0.02);
  expectNear(glb.vectors(glb.morph(0, "POSITION", 0)), openDeltas(), 0.02);
}

TEST(SceneWriter, DoesNotAddNormalsUnlessAsked) {
  const Rig rig = converted(headAndEyes());
  EXPECT_FALSE(write(rig).primitive(1)["attributes"].contains("NORMAL"));
  const Written glb = write(rig, {.morphNormals = true});
  EXPECT_TRUE(glb.primitive(1)["attributes"].contains("NORMAL"));
  for (std::size_t mesh = 0; mesh < 2; ++mesh)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(glb.vectors(glb.morph(k, "NORMAL", mesh)).size(), 9u);
}

TEST(SceneWriter, KeepsItsWeightsUnlessOthersAreGiven) {
  const Rig rig = converted(headAndEyes());
  const Written kept = write(rig);
  EXPECT_EQ(kept.json["meshes"][1]["weights"], Json({0.5, 0.0}));
  EXPECT_EQ(kept.json["nodes"][1]["weights"], Json({0.0, 0.25}));
  Weights weights(3, 0.0);
  weights[rig.find("open")] = 0.75;
  const Written given = write(rig, {.weights = weights});
  EXPECT_EQ(given.json["meshes"][0]["weights"], Json({0.75, 0.0}));
  EXPECT_EQ(given.json["meshes"][1]["weights"], Json({0.0, 0.75}));
  EXPECT_EQ(given.json["nodes"][1]["weights"], Json({0.0, 0.75}));
  EXPECT_FALSE(given.json["nodes"][0].contains("weights"));
}

/// Both meshes name the same accessors, but stand in different places.
TEST(SceneWriter, SeparatesMeshesThatSharedTheirVertices) {
  Glb source = smallFace();
  source.json["meshes"].push_back(source.json["meshes"][0]);
  source.add("nodes", {{"mesh", 1}, {"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}});
  const Rig rig = converted(source, 0.01);
  const Written glb = write(rig);
  for (std::size_t mesh = 0; mesh < 2; ++mesh) {
    expectNear(glb.vectors(glb.attribute("POSITION", mesh)), sheetPositions(), 0.02);
    expectNear(glb.vectors(glb.morph(0, "POSITION", mesh)), openDeltas(), 0.02);
  }
}

/// A copy of the face that has no targets is no part of the rig, though it shares its vertices.
TEST(SceneWriter, LeavesOtherMeshesAlone) {
  Glb source = smallFace();
  Json copy = source.json["meshes"][0];
  copy["primitives"][0].erase("targets");
  source.json["meshes"].push_back(std::move(copy));
  source.add("nodes", {{"mesh", 1}});
  const Rig rig = converted(source);
  for (const Index lod : {0, 3}) {
    const Written glb = write(rig, {.lod = lod});
    EXPECT_EQ(glb.vectors(glb.attribute("POSITION", 1)), sheetPositions());
    EXPECT_EQ(glb.indices(1).size(), sheetIndices().size());
    EXPECT_EQ(glb.numbers(glb.attribute("TEXCOORD_0", 1)).size(), 18u);
  }
}

// ---- Refusals ----

TEST(SceneWriter, RefusesAnotherFacesScene) {
  Rig rig = converted(smallFace());
  const std::string scene = rig.scene;
  const auto refuses = [&](std::string_view why) {
    for (const Index lod : {0, 2})
      EXPECT_TRUE(failsWith(formatGlb(rig, {.lod = lod}), {"do not fit", why, "convert"}));
  };
  rig.scene = "glTF";
  refuses("ends within its header; convert the source again.");
  rig.scene = scene.substr(0, scene.size() / 2);
  refuses("it is damaged");
  rig.scene = converted(headAndEyes()).scene;
  refuses("9 and 18 vertices");
}

/// The rig with a target that its scene lacks.
Rig withFrown(Rig rig) {
  rig.targets.push_back(rig.targets[1]);
  rig.targets.back().name = "frown";
  for (Vec3& d : rig.targets.back().difference) d *= -0.5;
  return rig;
}

/// Expressions are taken out and renamed by hand.
TEST(SceneWriter, KeepsTargetsThatTheFaceLostStill) {
  Rig rig = converted(smallFace());
  rig.targets.erase(rig.targets.begin());
  const Motion motion = *Motion::make(std::vector{0.0}, std::vector{1.0}, TimeLaw::newton, 1);
  for (const bool quantize : {false, true}) {
    const Written glb = write(rig, {.quantize = quantize, .weights = {0.5}, .motion = &motion});
    EXPECT_EQ(glb.json["meshes"][0]["extras"]["targetNames"], Json::array({"open", "wink"}));
    EXPECT_EQ(glb.json["meshes"][0]["weights"], Json({0.0, 0.5}));
    EXPECT_EQ(largest(glb.vectors(glb.morph(0))), 0);
    EXPECT_GT(largest(glb.vectors(glb.morph(1))), 0);
    for (const double time : {0.0, 0.25, 1.0}) {
      const std::vector<double> weights = evaluate(glb, glb.json["animations"][0], 0, time);
      ASSERT_EQ(weights.size(), 2u);
      EXPECT_EQ(weights[0], 0);
      EXPECT_NEAR(weights[1], motion.sample(0, time).position, 1e-6);
    }
  }
  rig.targets.clear();
  EXPECT_EQ(largest(write(rig).vectors(write(rig).morph(1))), 0);
  const Motion none = *Motion::make({}, {}, TimeLaw::newton, 1);
  EXPECT_TRUE(failsWith(formatGlb(rig, {.motion = &none}), {"no target in its scene"}));
}

TEST(SceneWriter, MakesRoomForNewTargets) {
  Glb source = richFace();
  const std::vector<float> times{0, 1}, moves{0.1f, 0.2f, 0.3f, 0.4f};
  const std::size_t input = source.addAccessor(source.addView(bytesOf(times)), 5126, "SCALAR", 2);
  const std::size_t output = source.addAccessor(source.addView(bytesOf(moves)), 5126, "SCALAR", 4);
  source.add("animations",
             {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
              {"channels",
               Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
  for (const Index lod : {0, 2}) {
    const Written glb = write(withFrown(converted(source)), {.lod = lod});
    const Json& mesh = glb.json["meshes"][0];
    EXPECT_EQ(mesh["extras"]["targetNames"], Json::array({"open", "wink", "frown"}));
    EXPECT_EQ(mesh["weights"].size(), 3u);
    const Json& targets = mesh["primitives"][0]["targets"];
    ASSERT_EQ(targets.size(), 3u);
    const auto wink = glb.vectors(targets[1]["POSITION"]),
               frown = glb.vectors(targets[2]["POSITION"]);
    for (std::size_t v = 0; v < wink.size(); ++v) EXPECT_LE(norm(frown[v] - wink[v] * -0.5), 1e-6);
    // Existing animations of weights still work.
    const Json& animation = glb.json["animations"][1];
    const std::size_t sampler = animation["channels"][0]["sampler"];
    const auto widened = glb.numbers(animation["samplers"][sampler]["output"]);
    ASSERT_EQ(widened.size(), 6u);
    EXPECT_EQ(widened[2], 0);
    EXPECT_NEAR(widened[4], 0.4, 1e-7);
  }
}

/// Exporters that find duplicates write them once.
TEST(SceneWriter, MakesRoomOnceForWhatAnimationsShare) {
  Glb source = smallFace();
  const std::vector<float> times{0, 1}, moves{0.1f, 0.2f, 0.3f, 0.4f};
  const std::size_t input = source.addAccessor(source.addView(bytesOf(times)), 5126, "SCALAR", 2);
  const std::size_t output = source.addAccessor(source.addView(bytesOf(moves)), 5126, "SCALAR", 4);
  for (int k = 0; k < 3; ++k)
    source.add("animations",
               {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                {"channels",
                 Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
  const Written glb = write(withFrown(converted(source)));
  std::set<std::size_t> outputs;
  for (const Json& animation : glb.json["animations"])
    outputs.insert(animation["samplers"].back()["output"].get<std::size_t>());
  ASSERT_EQ(outputs.size(), 1u);
  EXPECT_EQ(glb.numbers(*outputs.begin()).size(), 6u);
}

TEST(SceneWriter, MakesRoomForNewTargetsInAllPrimitives) {
  Glb source = smallFace();
  const std::size_t dots = source.addVectors({{0, 0, 0}, {1, 0, 0}});
  const Json still{{"POSITION", dots}};
  source.json["meshes"][0]["primitives"].push_back(
      {{"attributes", still}, {"mode", 0}, {"targets", Json::array({still, still})}});
  for (const Index lod : {0, 2}) {
    const Written glb = write(withFrown(converted(source)), {.lod = lod});
    ASSERT_EQ(glb.primitive(0, 1)["targets"].size(), 3u);
    EXPECT_EQ(glb.vectors(glb.morph(2, "POSITION", 0, 1)), std::vector<Vec3>(2));
  }
}

/// Adds an animation with a channel for each of `targets`, all of which play the same two keys.
void animate(Glb& glb, const std::vector<Json>& targets, const std::vector<float>& values) {
  const std::vector<float> times{0, 1};
  const std::size_t input = glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", 2);
  const std::size_t output =
      glb.addAccessor(glb.addView(bytesOf(values)), 5126, "SCALAR", values.size());
  Json channels = Json::array();
  for (const Json& target : targets) channels.push_back({{"sampler", 0}, {"target", target}});
  glb.add("animations", {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                         {"channels", channels}});
}
std::vector<double> animated(const Written& glb, std::size_t channel) {
  const Json& animation = glb.json["animations"][0];
  const std::size_t sampler = animation["channels"][channel]["sampler"];
  return glb.numbers(animation["samplers"][sampler]["output"].get<std::size_t>());
}

TEST(SceneWriter, MakesRoomOnceForWhatSeveralNodesShare) {
  Glb source = smallFace();
  const std::size_t other = source.add("nodes", {{"mesh", 0}});
  const auto weightsOf = [](std::size_t node) { return Json{{"node", node}, {"path", "weights"}}; };
  animate(source, std::vector<Json>{weightsOf(0), weightsOf(other)}, {0.1f, 0.2f, 0.3f, 0.4f});
  const Written glb = write(withFrown(converted(source)), {});
  EXPECT_EQ(glb.json["animations"][0]["samplers"].size(), 2u);
  for (const std::size_t channel : {0u, 1u}) EXPECT_EQ(animated(glb, channel).size(), 6u);
}

TEST(SceneWriter, MakesRoomForNewTargetsWherePointersMoveTheWeights) {
  Glb source = smallFace();
  std::vector<Json> targets;
  for (const char* pointer : {"/meshes/0/weights", "/nodes/0/weights", "/nodes/0/weights/1"}) {
    Json target{{"path", "pointer"}};
    target["extensions"]["KHR_animation_pointer"]["pointer"] = pointer;
    targets.push_back(target);
  }
  animate(source, targets, {0, 0.25f, 0.5f, 0.75f});
  source.json["extensionsUsed"] = {"KHR_animation_pointer"};
  const Written glb = write(withFrown(converted(source)));
  for (const std::size_t channel : {0, 1})
    EXPECT_EQ(animated(glb, channel), (std::vector<double>{0, 0.25, 0, 0.5, 0.75, 0}));
  EXPECT_EQ(animated(glb, 2), (std::vector<double>{0, 0.25, 0.5, 0.75})) << "one weight stays one";
}

TEST(SceneWriter, LeavesWeightsOfNoTargetsAsTheyWere) {
  Glb source = smallFace();
  source.primitive().erase("targets");
  source.json["meshes"][0].erase("extras");
  source.json["meshes"][0]["weights"] = {0.5};
  animate(source, {Json{{"node", 0}, {"path", "weights"}}}, {0.25f, 0.5f});
  Rig rig = converted(source);
  rig.targets.push_back({"frown", rig.neutral, {}});
  const Written glb = write(rig);
  EXPECT_EQ(glb.primitive()["targets"].size(), 1u);
  EXPECT_EQ(glb.json["meshes"][0]["weights"], Json::array({0.0})) << "the new one is at rest";
  EXPECT_EQ(animated(glb, 0), (std::vector<double>{0.25, 0.5}));
}

TEST(SceneWriter, AnswersAnyDamagedScene) {
  Rig rig = converted(smallFace());
  const std::string scene = gltf::glbOf(rig.scene).value();
  std::mt19937 random(7);
  for (int round = 0; round < 2000; ++round) {
    rig.scene = scene;
    for (int k = 0; k < 1 + round % 4; ++k)
      rig.scene[20 + random() % (scene.size() - 20)] =
          static_cast<char>("0123456789[]{}\",:-e"[random() % 19]);
    const auto bytes = formatGlb(
        rig, {.lod = round % 3, .morphNormals = round % 2 == 1, .quantize = round % 5 == 0});
    EXPECT_TRUE(bytes || failsWith(bytes, {"."}));
  }
}

/// Visits every value in a JSON.
void eachPlace(Json& json, const std::function<void(Json&)>& visit) {
  visit(json);
  if (!json.is_structured()) return;
  for (auto& [key, value] : json.items()) eachPlace(value, visit);
}

TEST(SceneWriter, AnswersAnySceneWithOneWrongValue) {
  Glb source = richFace();
  source.json["nodes"][0]["children"] = {1};
  source.primitive()["extensions"]["KHR_materials_variants"] = Json::object();
  Rig rig = converted(source), wider = withFrown(rig);
  const Motion motion =
      *Motion::make(std::vector{0.0, 0.0}, std::vector{1.0, 1.0}, TimeLaw::newton, 1);
  const std::vector<GlbOptions> options{{.morphNormals = true, .motion = &motion},
                                        {.lod = 2, .weights = {1, 0}},
                                        {.lod = 2, .quantize = true, .motion = &motion},
                                        {.quantize = true, .weights = {1, 0}}};
  const Written scene = sceneOf(rig);
  const std::vector<Json> wrong{nullptr,
                                -1,
                                7,
                                1e9,
                                1.5,
                                "text",
                                true,
                                Json::array(),
                                Json::object(),
                                Json::array({nullptr})};
  Json json = scene.json;
  std::vector<Json*> places;
  eachPlace(json, [&](Json& place) { places.push_back(&place); });
  std::size_t accepted = 0, refusedOnes = 0;
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t w = 0; w < wrong.size(); ++w) {
      Json before = wrong[w];
      std::swap(*places[k], before);
      rig.scene = gltf::formatContainer(json, scene.binary);
      std::swap(*places[k], before);
      wider.scene = rig.scene;
      EXPECT_TRUE(formatGlb(wider, {}) || failsWith(formatGlb(wider, {}), {"."}));
      const auto bytes = formatGlb(rig, options[(k + w) % options.size()]);
      EXPECT_TRUE(bytes || failsWith(bytes, {"."}));
      ++(bytes ? accepted : refusedOnes);
    }
  EXPECT_GT(accepted, 100u);
  EXPECT_GT(refusedOnes, 100u);
}

}  // namespace
}  // namespace sweepface
