// GLB files with KHR_mesh_quantization.
#include <numeric>

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// Half a quantization step of the cube that a node scales.
double halfStep(const Json& node) { return 0.5 * node["scale"][0].get<double>() / 32767; }

std::vector<Vec3> enlarged(const Json& node, std::vector<Vec3> list, double w) {
  const Json& t = node["translation"];
  for (Vec3& p : list)
    p = p * node["scale"][0].get<double>() +
        w * Vec3{t[0].get<double>(), t[1].get<double>(), t[2].get<double>()};
  return list;
}

void expectWithin(const std::vector<Vec3>& found, const std::vector<Vec3>& expected, double each) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v) {
    const Vec3 d = found[v] - expected[v];
    EXPECT_LE(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), each) << "vertex " << v;
  }
}

std::vector<Vec3> difference(const Rig& rig, std::size_t target) {
  std::vector<Vec3> list = surfacePositions(rig, oneTarget(rig, target));
  const std::vector<Vec3> neutral = surfacePositions(rig);
  for (std::size_t v = 0; v < list.size(); ++v) list[v] -= neutral[v];
  return list;
}

/// Expects the mesh's node to show the surface within half a step.
void expectSurface(const Rig& rig, const Written& glb, const Json& node) {
  const double near = 1.01 * halfStep(node);
  expectWithin(enlarged(node, glb.vectors(glb.attribute("POSITION")), 1), surfacePositions(rig),
               near);
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    expectWithin(enlarged(node, glb.vectors(glb.morph(k)), 0), difference(rig, k), near);
}

TEST(QuantizeWriter, StaysWithinHalfAStep) {
  for (const double shift : {0.0, 1000.0}) {
    MeshRig source = withTargets(plane(8, 6), 2);
    for (Vec3& p : source.neutral.positions) p.y += shift;
    for (MeshTarget& t : source.targets)
      for (Vec3& p : t.positions) p.y += shift;
    const Rig rig = converted(source);
    const Written glb = write(rig, {.quantize = true});
    EXPECT_EQ(glb.json["extensionsUsed"], Json::array({"KHR_mesh_quantization"}));
    EXPECT_EQ(glb.json["extensionsRequired"], Json::array({"KHR_mesh_quantization"}));
    ASSERT_EQ(glb.json["nodes"].size(), 1u) << "a node that does nothing else takes the scale";
    expectSurface(rig, glb, glb.json["nodes"][0]);
    EXPECT_LE(halfStep(glb.json["nodes"][0]), 6.0 / 65000);
  }
}

TEST(QuantizeWriter, HoldsSixteenBitsInAlignedElements) {
  const Written glb = write(converted(withTargets(plane(8, 6), 2)), {.quantize = true});
  for (const std::size_t a : {glb.attribute("POSITION"), glb.attribute("NORMAL"), glb.morph(0)}) {
    EXPECT_EQ(glb.accessor(a)["componentType"], 5122);
    EXPECT_EQ(glb.accessor(a)["normalized"], true);
    if (glb.isSparse(a)) continue;
    const Json& view = glb.json["bufferViews"][glb.accessor(a)["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteStride"], 8);
  }
  EXPECT_TRUE(glb.accessor(glb.attribute("POSITION"))["max"][0].is_number_integer());
  const std::vector<double> stored = glb.stored(glb.attribute("POSITION"));
  EXPECT_EQ(glb.accessor(glb.attribute("POSITION"))["max"][0], stored[3 * 8]);
}

TEST(QuantizeWriter, KeepsNormals) {
  const Rig rig = converted(withTargets(plane(8, 6), 2));
  const Written glb = write(rig, {.morphNormals = true, .quantize = true});
  expectNear(glb.vectors(glb.attribute("NORMAL")), surfaceNormals(rig), 1e-4);
  std::vector<Vec3> moved = glb.vectors(glb.morph(1, "NORMAL"));
  const std::vector<Vec3> base = glb.vectors(glb.attribute("NORMAL"));
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += base[v];
  expectNear(moved, surfaceNormals(rig, oneTarget(rig, 1)), 1e-4);
}

TEST(QuantizeWriter, HoldsNormalsThatTurnFarAsFloats) {
  MeshRig source = withTargets(plane(8, 6), 1);
  for (std::size_t v = 0; v < source.neutral.positions.size(); ++v) {
    const Vec3 p = source.neutral.positions[v];
    source.targets[0].positions[v] = {p.x, -p.y, p.z};  // turned over
  }
  const Rig rig = converted(source);
  const Written glb = write(rig, {.morphNormals = true, .quantize = true});
  EXPECT_EQ(glb.accessor(glb.morph(0, "NORMAL"))["componentType"], 5126);
  std::vector<Vec3> moved = glb.vectors(glb.morph(0, "NORMAL"));
  const std::vector<Vec3> base = glb.vectors(glb.attribute("NORMAL"));
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v] += base[v];
  expectNear(moved, surfaceNormals(rig, oneTarget(rig, 0)), 1e-4);
}

TEST(QuantizeWriter, TakesLessRoom) {
  const Rig rig = converted(withTargets(plane(30, 30), 3), 0.2);
  EXPECT_LT(write(rig, {.quantize = true}).binary.size(),
            0.75 * static_cast<double>(write(rig).binary.size()));
}

// ---- In scenes ----

void animateFirstNode(Glb& glb, std::initializer_list<const char*> paths) {
  const std::size_t input =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0, 2})), 5126, "SCALAR", 2);
  const std::size_t output =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0, 0, 1, 1, 2, 2})), 5126, "VEC3", 2);
  Json channels = Json::array();
  for (const char* path : paths)
    channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}});
  glb.add("animations", {{"samplers", Json::array({{{"input", input}, {"output", output}}})},
                         {"channels", channels}});
}

TEST(QuantizeWriter, HangsTheMeshBelowANodeThatIsMoreThanAPlace) {
  Glb source = smallFace();
  source.json["nodes"][0] = {{"name", "head"},
                             {"mesh", 0},
                             {"weights", {0.5, 0.0}},
                             {"translation", {1, 2, 3}},
                             {"children", {1}}};
  source.add("nodes", {{"name", "hat"}});
  animateFirstNode(source, {"weights", "translation"});
  const Rig rig = converted(source);
  const Motion motion =
      *Motion::make(std::vector{0.0, 0.0}, std::vector{1.0, 0.0}, TimeLaw::newton, 1);
  const Written glb = write(rig, {.quantize = true, .motion = &motion});
  const Json& nodes = glb.json["nodes"];
  ASSERT_EQ(nodes.size(), 3u);
  EXPECT_FALSE(nodes[0].contains("mesh"));
  EXPECT_FALSE(nodes[0].contains("weights"));
  EXPECT_EQ(nodes[0]["translation"], Json({1, 2, 3}));
  EXPECT_EQ(nodes[0]["children"], Json({1, 2}));
  EXPECT_EQ(nodes[2]["mesh"], 0);
  EXPECT_EQ(nodes[2]["weights"], Json({0.5, 0.0}));
  const Json& old = glb.json["animations"][0]["channels"];
  EXPECT_EQ(old[0]["target"]["node"], 2) << "the weights went with the mesh";
  EXPECT_EQ(old[1]["target"]["node"], 0);
  EXPECT_EQ(glb.json["animations"][1]["channels"][0]["target"]["node"], 2);
  std::vector<Vec3> placed = enlarged(nodes[2], glb.vectors(glb.attribute("POSITION")), 1);
  for (Vec3& p : placed) p += Vec3{1, 2, 3};
  expectWithin(placed, surfacePositions(rig), 1.01 * halfStep(nodes[2]));
}

TEST(QuantizeWriter, HangsTheMeshBelowANodeThatAnAnimationMoves) {
  Glb source = smallFace();
  animateFirstNode(source, {"translation"});
  const Json nodes = write(converted(source), {.quantize = true}).json["nodes"];
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[0], Json({{"children", {1}}}));
  EXPECT_EQ(nodes[1]["mesh"], 0);
}

/// A skinned vertex is placed by the inverse bind matrix, then by the joint.
TEST(QuantizeWriter, ScalesByTheMatricesOfASkin) {
  Glb source = smallFace();
  std::vector<std::uint8_t> joints(36, 0);
  std::vector<float> weights(36, 0), matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1};
  for (std::size_t v = 0; v < 36; v += 4) weights[v] = 1;
  Json& attributes = source.primitive()["attributes"];
  attributes["JOINTS_0"] = source.addAccessor(source.addView(bytesOf(joints)), 5121, "VEC4", 9);
  attributes["WEIGHTS_0"] = source.addAccessor(source.addView(bytesOf(weights)), 5126, "VEC4", 9);
  source.add("nodes", {{"name", "joint"}, {"translation", {2, 0, 0}}});
  for (const bool given : {true, false}) {
    Glb glbSource = source;
    Json skin{{"joints", {1}}};
    if (given)
      skin["inverseBindMatrices"] =
          glbSource.addAccessor(glbSource.addView(bytesOf(matrix)), 5126, "MAT4", 1);
    glbSource.add("skins", skin);
    glbSource.json["nodes"][0]["skin"] = 0;
    glbSource.json["nodes"][0]["children"] = {2};
    glbSource.add("nodes", {{"name", "hat"}});
    const Rig rig = converted(glbSource);
    const Written glb = write(rig, {.quantize = true});
    EXPECT_EQ(glb.json["nodes"].size(), 3u) << "a skin ignores nodes";
    if (given) {
      EXPECT_EQ(glb.json["skins"][0], skin);
    }
    const std::size_t number = glb.json["nodes"][0]["skin"];
    EXPECT_EQ(number, 1u);
    const auto m = glb.numbers(glb.json["skins"][number]["inverseBindMatrices"]);
    ASSERT_EQ(m.size(), 16u);
    std::vector<Vec3> placed = glb.vectors(glb.attribute("POSITION"));
    for (Vec3& p : placed)
      p = Vec3{m[0] * p.x + m[12], m[5] * p.y + m[13], m[10] * p.z + m[14]} + Vec3{2, 0, 0};
    expectWithin(placed, surfacePositions(rig), 1.01 * 0.5 * m[0] / 32767);
    EXPECT_EQ(m[15], 1);
  }
}

TEST(QuantizeWriter, LeavesJointsOfOtherMeshesAsTheyAre) {
  Glb source = smallFace();
  source.add("skins", {{"joints", {0}}});
  const Rig rig = converted(source);
  const Json nodes = write(rig, {.quantize = true}).json["nodes"];
  ASSERT_EQ(nodes.size(), 2u);
  EXPECT_EQ(nodes[0], Json({{"children", {1}}}));
  EXPECT_EQ(nodes[1]["mesh"], 0);
  EXPECT_TRUE(nodes[1].contains("scale"));
}

TEST(QuantizeWriter, LeavesWhatNoNodeShowsAsItIs) {
  Glb source = smallFace();
  source.add("meshes", source.json["meshes"][0]);  // after the one that is on a node
  const Rig rig = converted(source);
  const Written glb = write(rig, {.quantize = true});
  const auto componentOf = [&](std::size_t mesh) {
    const Json& attributes = glb.json["meshes"][mesh]["primitives"][0]["attributes"];
    return glb.accessor(attributes["POSITION"].get<std::size_t>())["componentType"];
  };
  EXPECT_EQ(componentOf(0), 5122);
  EXPECT_EQ(componentOf(1), 5126);
}

TEST(QuantizeWriter, RefusesWhatItWouldEnlarge) {
  const auto refuses = [](const Glb& source, std::string_view why) {
    EXPECT_TRUE(
        failsWith(formatGlb(converted(source), {.quantize = true}), {"cannot be quantized", why}));
  };
  Glb points = smallFace();
  Json cloud = points.primitive();
  cloud["mode"] = 0;
  cloud.erase("indices");
  points.json["meshes"][0]["primitives"].push_back(cloud);
  refuses(points, "besides it");

  Glb avatar = smallFace();
  avatar.json["nodes"][0]["children"] = {1};
  avatar.add("nodes", {{"name", "hat"}});
  avatar.json["extensionsUsed"] = {"VRMC_vrm"};
  refuses(avatar, "VRMC_vrm");

  Glb pointed = smallFace();  // pointers may move the node
  pointed.json["extensionsUsed"] = {"KHR_animation_pointer"};
  refuses(pointed, "KHR_animation_pointer");

  Glb crowd = smallFace();
  crowd.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  crowd.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      crowd.addVectors({{1, 0, 0}, {2, 0, 0}});
  refuses(crowd, "EXT_mesh_gpu_instancing");
  crowd.json.erase("extensionsUsed");
  refuses(crowd, "EXT_mesh_gpu_instancing");
}

}  // namespace
}  // namespace sweepface
