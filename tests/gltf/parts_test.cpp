#include "gltf/parts.hpp"

#include "gltf/glb.hpp"
#include "gltf/nodes.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using gltf::Affine;

gltf::Parts partsOf(const Glb& glb) {
  const auto document = gltf::parseDocument(glb.bytes(), {});
  if (!document) ADD_FAILURE() << document.error().message;
  if (!document) return {};
  auto parts = gltf::findParts(*document);
  if (!parts) ADD_FAILURE() << parts.error().message;
  return parts ? std::move(*parts) : gltf::Parts{};
}

/// A triangle; `targets` are the accessors of its targets' positions.
Json triangle(std::size_t position, const std::vector<std::size_t>& targets = {}) {
  Json primitive = {{"attributes", {{"POSITION", position}}}};
  for (std::size_t target : targets) primitive["targets"].push_back({{"POSITION", target}});
  return primitive;
}
std::vector<Vec3> threePoints(double z = 0) { return {{0, 0, z}, {1, 0, z}, {0, 1, z}}; }

// ---- Which primitives ----

TEST(Parts, AreAllTrianglesWhereNoneMorphs) {
  Glb glb;
  const std::size_t a = glb.addVectors(threePoints()), b = glb.addVectors(threePoints(1));
  glb.add("meshes", {{"primitives", {triangle(a), triangle(b)}}});
  Json lines = triangle(a);
  lines["mode"] = 1;
  glb.add("meshes", {{"primitives", {lines, triangle(b)}}});
  const auto parts = partsOf(glb);
  ASSERT_EQ(parts.parts.size(), 3u);
  EXPECT_EQ(parts.parts[2].primitive, 1u);
  EXPECT_EQ(parts.vertexCount, 9u);
  EXPECT_TRUE(parts.targets.empty());
}

TEST(Parts, AreThoseThatMorphWhereSomeDo) {
  Glb glb = smallFace();
  const std::size_t hair = glb.addVectors(threePoints());
  glb.add("meshes", {{"name", "hair"}, {"primitives", {triangle(hair)}}});
  const auto parts = partsOf(glb);
  ASSERT_EQ(parts.parts.size(), 1u);
  EXPECT_EQ(parts.vertexCount, 9u);
}

TEST(Parts, ShareVerticesWhereTheyShareAllAccessorsWithinAMesh) {
  Glb glb;
  const std::size_t p = glb.addVectors(threePoints()), t = glb.addVectors(threePoints()),
                    u = glb.addVectors(threePoints());
  glb.add("meshes", {{"primitives", {triangle(p, {t}), triangle(p, {u}), triangle(p, {t})}}});
  glb.add("meshes", {{"primitives", {triangle(p, {t})}}});
  const auto parts = partsOf(glb);
  ASSERT_EQ(parts.runs.size(), 3u);
  EXPECT_EQ(parts.vertexCount, 9u);
  EXPECT_EQ(parts.parts[0].run, parts.parts[2].run);
  EXPECT_NE(parts.parts[0].run, parts.parts[1].run);
  EXPECT_EQ(parts.runs[2].first, 6u);
}

TEST(Parts, WithoutTrianglesAreRefused) {
  Glb glb;
  EXPECT_TRUE(refused(glb, {"it has no triangles"}));
  const std::size_t p = glb.addVectors(threePoints());
  for (const int mode : {0, 1, 2, 3}) {
    glb.json["meshes"] = Json::array({{{"primitives", Json::array({triangle(p)})}}});
    glb.primitive()["mode"] = mode;
    EXPECT_TRUE(refused(glb, {"it has no triangles"})) << mode;
  }
  glb.primitive()["mode"] = 7;
  EXPECT_TRUE(refused(glb, {"it has no triangles"}));
}

TEST(Parts, MustSayThingsOfTheRightKind) {
  const auto expectRefused = [](auto change, std::string_view why) {
    Glb glb = smallFace();
    change(glb.primitive());
    EXPECT_TRUE(refused(glb, {"mesh 0 'head', primitive 0", why}));
  };
  expectRefused([](Json& p) { p = 3; }, "it is not an object");
  expectRefused([](Json& p) { p["mode"] = "4"; }, "'mode' is not a whole number");
  expectRefused([](Json& p) { p["attributes"] = 1; }, "'attributes' is not an object");
  expectRefused([](Json& p) { p["attributes"].erase("POSITION"); }, "triangles without POSITION");
  expectRefused([](Json& p) { p["attributes"]["POSITION"] = 99; }, "'POSITION' is 99");
  expectRefused([](Json& p) { p["attributes"]["POSITION"] = {1}; }, "'POSITION' is not a whole");
  expectRefused([](Json& p) { p["attributes"]["COLOR_0"] = -1; }, "'COLOR_0' is none of the");
  expectRefused([](Json& p) { p["attributes"]["POSITION"] = 2; },
                "its POSITION is not of type VEC3");
  expectRefused([](Json& p) { p["attributes"]["NORMAL"] = 2; }, "its NORMAL is not of type VEC3");
  expectRefused([](Json& p) { p["targets"] = 1; }, "'targets' is not a list");
  expectRefused([](Json& p) { p["targets"][0] = 1; }, "target 0: it is not an object");
  expectRefused([](Json& p) { p["targets"][1]["POSITION"] = "x"; }, "target 1: its 'POSITION'");
  expectRefused([](Json& p) { p["targets"][1]["POSITION"] = 2; }, "target 1: its POSITION is not");
  expectRefused([](Json& p) { p["material"] = 1; },
                "'material' is 1, but the file has 1 materials");
  expectRefused([](Json& p) { p["indices"] = 77; }, "'indices' is 77");
  expectRefused([](Json& p) { p["extensions"] = 1; }, "'extensions' is not an object");
}

TEST(Parts, AttributesHaveOneElementAVertex) {
  Glb glb = smallFace();
  const std::size_t three = glb.addVectors(threePoints());
  glb.primitive()["attributes"]["NORMAL"] = three;
  EXPECT_TRUE(refused(glb, {"its 'NORMAL' has 3 elements, but POSITION 9"}));
  glb = smallFace();
  glb.primitive()["targets"][1]["POSITION"] = glb.addVectors(threePoints());
  EXPECT_TRUE(refused(glb, {"target 1: its 'POSITION' has 3 elements, but POSITION 9"}));
}

TEST(Parts, OfOneMeshHaveAsManyTargets) {
  Glb glb;
  const std::size_t p = glb.addVectors(threePoints());
  glb.add("meshes", {{"primitives", {triangle(p, {p, p}), triangle(p, {p})}}});
  EXPECT_TRUE(refused(glb, {"mesh 0, primitive 1: it has 1 morph targets, but the mesh's first one "
                            "2"}));
}

// ---- Names of targets ----

TEST(TargetNames, AreThoseOfTheMesh) {
  EXPECT_EQ(partsOf(smallFace()).targets, (std::vector<std::string>{"open", "wink"}));
}

TEST(TargetNames, MayStandAtThePrimitive) {
  Glb glb = smallFace();
  glb.json["meshes"][0].erase("extras");
  glb.primitive()["extras"]["targetNames"] = {"a", "b"};
  EXPECT_EQ(partsOf(glb).targets, (std::vector<std::string>{"a", "b"}));
}

TEST(TargetNames, AreNumbersWhereThereAreNone) {
  const auto namesWith = [](const Json& extras) {
    Glb glb = smallFace();
    glb.json["meshes"][0]["extras"] = extras;
    return partsOf(glb).targets;
  };
  const std::vector<std::string> numbers{"target_0", "target_1"};
  for (const Json& extras : {Json(), Json(1), Json::object(), Json::object({{"targetNames", 5}}),
                             Json::object({{"targetNames", Json::array({1, Json::array()})}})})
    EXPECT_EQ(namesWith(extras), numbers) << extras;
  EXPECT_EQ(namesWith({{"targetNames", {"open"}}}), (std::vector<std::string>{"open", "target_1"}));
  EXPECT_EQ(namesWith({{"targetNames", {" ", "b", "c"}}}),
            (std::vector<std::string>{"target_0", "b"}));
  // A number that is taken is skipped.
  EXPECT_EQ(namesWith({{"targetNames", {"target_1"}}}),
            (std::vector<std::string>{"target_1", "target_2"}));
}

TEST(TargetNames, MayBeAHundredThousandNumbers) {
  Glb glb = smallFace();
  for (int k = 0; k < 100'000; ++k) glb.primitive()["targets"].push_back(Json::object());
  glb.json["meshes"][0]["extras"]["targetNames"] = {"target_2"};
  const std::vector<std::string> names = partsOf(glb).targets;
  EXPECT_EQ(names[1], "target_1");
  EXPECT_EQ(names[2], "target_3");
  EXPECT_EQ(names.back(), "target_100002");
}

TEST(TargetNames, OfSeveralMeshesAreUnited) {
  Glb glb = smallFace();
  const std::size_t p = glb.addVectors(threePoints()), t = glb.addVectors(threePoints(2));
  glb.add("meshes", {{"primitives", Json::array({triangle(p, {t, t})})},
                     {"extras", {{"targetNames", {"smile", "open"}}}}});
  const auto parts = partsOf(glb);
  EXPECT_EQ(parts.targets, (std::vector<std::string>{"open", "wink", "smile"}));
  EXPECT_EQ(parts.meshes[0].targets, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(parts.meshes[1].targets, (std::vector<std::size_t>{2, 0}));
}

TEST(TargetNames, TwiceInAMeshAreRefused) {
  Glb glb = smallFace();
  glb.json["meshes"][0]["extras"]["targetNames"] = {"open", "open"};
  EXPECT_TRUE(refused(glb, {"mesh 0 'head': two of its morph targets are named 'open'"}));
}

TEST(TargetNames, WithControlCharactersAreRefused) {
  Glb glb = smallFace();
  glb.json["meshes"][0]["extras"]["targetNames"] = {"open", "a\nb"};
  EXPECT_TRUE(refused(glb, {"the name 'a?b' of a morph target has control characters"}));
}

// ---- Nodes ----

std::vector<Affine> worldOf(const Json& nodes) {
  Glb glb;
  glb.json["nodes"] = nodes;
  return gltf::worldMatrices(gltf::parseDocument(glb.bytes(), {}).value()).value();
}

void expectAt(const Vec3& a, const Vec3& b) {
  EXPECT_NEAR(norm(a - b), 0, 1e-12) << a.x << " " << a.y << " " << a.z;
}

TEST(Nodes, PlaceByTranslationRotationAndScale) {
  const double h = std::sqrt(0.5);  // a quarter turn about z
  const auto world =
      worldOf({{{"translation", {10, 20, 30}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}}});
  expectAt(world[0].point({1, 0, 0}), {10, 22, 30});
  expectAt(world[0].point({0, 1, 0}), {7, 20, 30});
  expectAt(world[0].direction({0, 0, 1}), {0, 0, 4});
}

TEST(Nodes, PlaceByMatrix) {
  const auto world = worldOf({{{"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1}}}});
  expectAt(world[0].point({1, 1, 1}), {7, 22, 34});
}

TEST(Nodes, PlaceWithinTheirParents) {
  const auto world = worldOf({{{"translation", {1, 0, 0}}},
                              {{"scale", {2, 2, 2}}, {"children", {2}}},
                              {{"translation", {0, 1, 0}}, {"children", {0}}}});
  expectAt(world[0].point({0, 0, 0}), {2, 2, 0});
}

TEST(Nodes, AMatrixAndItsInverseUndoEachOther) {
  const auto world = worldOf({{{"translation", {1, 2, 3}},
                               {"rotation", {0.1, -0.7, 0.5, 0.5}},
                               {"scale", {0.5, -2, 3e-4}}}});
  const Affine both = world[0].inverse() * world[0];
  expectAt(both.point({1, 2, 3}), {1, 2, 3});
  EXPECT_TRUE(world[0].mirrors());
  EXPECT_FALSE(world[0].isSingular());
}

TEST(Nodes, MustFormATree) {
  const auto refusedNodes = [](const Json& nodes, std::string_view why) {
    Glb glb = smallFace();
    glb.json["nodes"] = nodes;
    EXPECT_TRUE(refused(glb, {why}));
  };
  refusedNodes({{{"children", {0}}}}, "in a circle");
  refusedNodes({{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}}, "child 1 is also");
  refusedNodes({{{"children", {1}}}, {{"children", {2}}}, {{"children", {0}}}}, "in a circle");
  refusedNodes({{{"children", {2}}}, {{"children", {2}}}, Json::object()},
               "node 1: its child 2 is also one of node 0");
  refusedNodes({{{"children", {3}}}}, "node 0: one of its children is none of the 1 nodes");
  refusedNodes({{{"children", "all"}}}, "node 0: 'children' is not a list");
  refusedNodes({{{"children", {Json::object()}}}}, "is none of the 1 nodes");
  refusedNodes({{{"mesh", 4}}}, "node 0: 'mesh' is 4, but the file has 1 meshes");
  refusedNodes({{{"matrix", {1, 2, 3}}}}, "node 0: 'matrix' is not a list of 16 numbers");
  refusedNodes({{{"translation", {1, 2, "3"}}}}, "'translation' is not a list of 3 numbers");
  refusedNodes({{{"rotation", 1}}}, "'rotation' is not a list");
}

TEST(Nodes, OfAHundredThousandLevelsAreRead) {
  Json nodes = Json::array();
  for (int k = 0; k < 100'000; ++k)
    nodes.push_back({{"children", {k + 1}}, {"translation", {0, 0, 1}}});
  nodes.push_back(Json::object());
  expectAt(worldOf(nodes).back().origin, {0, 0, 100'000});
}

TEST(Nodes, ThatFlattenAFaceAreRefused) {
  const auto refusedNode = [](const Json& node) {
    Glb glb = smallFace();
    glb.json["nodes"] = Json::array({node});
    glb.json["nodes"][0]["mesh"] = 0;
    EXPECT_TRUE(refused(glb, {"mesh 0 'head': its node flattens it or has no finite matrix"}));
  };
  refusedNode({{"scale", {1, 0, 1}}});
  refusedNode({{"matrix", {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  refusedNode({{"matrix", {1, 2, 3, 0, 4, 5, 6, 0, 5, 7, 9, 0, 0, 0, 0, 1}}});
  refusedNode({{"scale", {1e308, 1, 1}}, {"rotation", {0, 9, 9, 9}}});
}

TEST(Nodes, MatricesMustBeAffine) {
  Glb glb = smallFace();
  glb.json["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(refused(glb, {"node 0: the last row of its matrix is not 0 0 0 1"}));
}

}  // namespace
}  // namespace sweepface
