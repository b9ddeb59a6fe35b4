#include "gltf/chosen_meshes.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Names = std::vector<std::string>;

/// The small face, its teeth with "open" in a group "jaw", a coarser face with "open" and one
/// of its own, "far", and a hat without targets; all of them shown, but not the coarse one.
Glb character() {
  Glb glb = smallFace();
  glb.json["nodes"][0]["name"] = "Face";
  Json teeth = glb.primitive(), coarse = glb.primitive(), hat = glb.primitive();
  teeth["targets"].erase(1);
  hat.erase("targets");
  glb.add("meshes", {{"name", "teeth"},
                     {"primitives", Json::array({teeth})},
                     {"extras", {{"targetNames", {"open"}}}}});
  glb.add("meshes", {{"name", "head_lod"},
                     {"primitives", Json::array({coarse})},
                     {"weights", {0.0, 0.25}},
                     {"extras", {{"targetNames", {"open", "far"}}}}});
  glb.add("meshes", {{"name", "hat"}, {"primitives", Json::array({hat})}});
  glb.add("nodes", {{"name", "teeth"}, {"mesh", 1}});
  glb.add("nodes", {{"name", "jaw"}, {"children", {1}}});
  glb.add("nodes", {{"name", "coarse"}, {"mesh", 2}});
  glb.add("nodes", {{"name", "hat"}, {"mesh", 3}});
  glb.add("scenes", {{"nodes", {0, 2, 4}}});
  return glb;
}

RigSource chosen(const Glb& glb, const Names& names) {
  auto source = parseGltf(glb.bytes(), "face.glb", {}, {.meshes = names});
  if (source) return std::move(*source);
  ADD_FAILURE() << source.error().message;
  return {};
}

/// The groups of the faces are the names of the meshes.
Names meshesOf(const RigSource& source) { return source.rig.neutral.polygons.groups; }

Names targetsOf(const RigSource& source) {
  Names names;
  for (const MeshTarget& target : source.rig.targets) names.push_back(target.name);
  return names;
}

TEST(ChosenMeshes, AreThoseThatMorphInTheSceneOfTheFile) {
  const RigSource source = read(character());
  EXPECT_EQ(meshesOf(source), (Names{"head", "teeth"}));
  EXPECT_EQ(targetsOf(source), (Names{"open", "wink"}));
  EXPECT_EQ(source.faceWarnings,
            (Names{"Meshes that the file's scene does not show are not part of the face: mesh 2 "
                   "'head_lod'; to have others, choose meshes by their names (--mesh)."}));
}

TEST(ChosenMeshes, AreThoseOfTheSceneThatTheFileNames) {
  Glb glb = character();
  glb.add("scenes", {{"nodes", {3}}});
  EXPECT_EQ(meshesOf(read(glb)), (Names{"head", "teeth"}));
  glb.json["scene"] = 1;
  EXPECT_EQ(meshesOf(read(glb)), (Names{"head_lod"}));
}

TEST(ChosenMeshes, AreAllIfTheSceneShowsNoneOfThem) {
  Glb glb = character();
  glb.json["scenes"][0]["nodes"] = {4};
  const RigSource source = read(glb);
  EXPECT_EQ(meshesOf(source), (Names{"head", "teeth", "head_lod"}));
  EXPECT_TRUE(source.faceWarnings.empty());
}

TEST(ChosenMeshes, AreNamedByTheirNodes) {
  EXPECT_EQ(meshesOf(chosen(character(), {"Face"})), (Names{"head"}));
  EXPECT_EQ(meshesOf(chosen(character(), {"coarse"})), (Names{"head_lod"}));
  EXPECT_EQ(targetsOf(chosen(character(), {"coarse"})), (Names{"open", "far"}));
}

TEST(ChosenMeshes, AreNamedByNodesAboveThem) {
  EXPECT_EQ(meshesOf(chosen(character(), {"jaw"})), (Names{"teeth"}));
}

TEST(ChosenMeshes, AreNamedByTheirOwnNamesWhereNoNodeIs) {
  EXPECT_EQ(meshesOf(chosen(character(), {"head_lod"})), (Names{"head_lod"}));
  Glb glb = character();
  glb.json["nodes"][4]["name"] = "head";
  EXPECT_EQ(meshesOf(chosen(glb, {"head"})), (Names{"hat"}));
  glb.json["nodes"][2]["name"] = "head";  // as a bone with teeth on it may be called
  glb.json["nodes"][4]["name"] = "hat";
  EXPECT_EQ(meshesOf(chosen(glb, {"head"})), (Names{"head"}));
  for (Json& mesh : glb.json["meshes"]) mesh["name"] = "Mesh";
  EXPECT_EQ(chosen(glb, {"Mesh"}).rig.neutral.positions.size(), 36u) << "all that are called so";
}

TEST(ChosenMeshes, AreNumberedWhereNothingIsCalledSo) {
  EXPECT_EQ(meshesOf(chosen(character(), {"2"})), (Names{"head_lod"}));
  Glb glb = character();
  glb.json["nodes"][4]["name"] = "2";
  EXPECT_EQ(meshesOf(chosen(glb, {"2"})), (Names{"hat"}));
}

TEST(ChosenMeshes, AreInTheOrderOfTheFile) {
  EXPECT_EQ(meshesOf(chosen(character(), {"teeth", "Face", "teeth"})), (Names{"head", "teeth"}));
}

/// So that what meets a face can be part of it.
TEST(ChosenMeshes, NeedNoTargets) {
  const RigSource source = chosen(character(), {"Face", "hat"});
  EXPECT_EQ(meshesOf(source), (Names{"head", "hat"}));
  EXPECT_EQ(targetsOf(source), (Names{"open", "wink"}));
  ASSERT_EQ(source.rig.neutral.positions.size(), 18u);
  for (std::size_t v = 9; v < 18; ++v)
    EXPECT_EQ(source.rig.targets[0].positions[v], source.rig.neutral.positions[v]);
  EXPECT_TRUE(chosen(character(), {"hat"}).rig.targets.empty());
}

TEST(ChosenMeshes, AreRefusedWhereNothingIsCalledSo) {
  const auto refuse = [](const Glb& glb, std::string_view why) {
    return failsWith(parseGltf(glb.bytes(), "face.glb", {}, {.meshes = {"Face", "jam"}}), {why});
  };
  EXPECT_TRUE(refuse(character(),
                     "face.glb: no object with meshes and no mesh is named 'jam'; there are "
                     "'Face', 'teeth', 'coarse', 'hat'."));
  Glb glb = character();
  glb.add("nodes", {{"name", "jam"}});
  EXPECT_TRUE(refuse(glb, "no mesh is named 'jam'; there are 'Face',"));
  for (Json& node : glb.json["nodes"]) node.erase("name");
  EXPECT_TRUE(refuse(glb, "no mesh is named 'Face'; there are 'head', 'teeth', 'head_lod', 'hat'"));
  for (Json& mesh : glb.json["meshes"]) mesh.erase("name");
  EXPECT_TRUE(refuse(glb, "named 'Face'; its 4 meshes have none, but numbers from 0."));
}

TEST(ChosenMeshes, AreRefusedWithoutTriangles) {
  Glb glb = character();
  glb.primitive(3)["mode"] = 1;
  EXPECT_TRUE(failsWith(parseGltf(glb.bytes(), "face.glb", {}, {.meshes = {"Face", "hat"}}),
                        {"face.glb: mesh 3 'hat': it has no triangles; choose other meshes."}));
}

Rig rigOf(const Glb& glb, const Names& names = {}) {
  RigSource source = names.empty() ? read(glb) : chosen(glb, names);
  Rig rig = converted(source.rig);
  rig.scene = std::move(source.scene);
  return rig;
}

TEST(ChosenMeshes, AreThoseOfTheSceneToo) {
  for (const Names& names : {Names{}, Names{"teeth"}, Names{"Face", "hat"}}) {
    const Rig rig = rigOf(character(), names);
    EXPECT_TRUE(checkScene(rig));
    EXPECT_EQ(sceneOf(rig).json["extensions"].size(), 1u);
    const Written glb = write(rig);
    EXPECT_FALSE(glb.json.contains("extensions"));
    EXPECT_EQ(glb.json["meshes"].size(), 4u);
    for (std::size_t mesh = 0; mesh < 4; ++mesh)
      EXPECT_EQ(glb.vectors(glb.attribute("POSITION", mesh)).size(), 9u);
  }
  EXPECT_FALSE(sceneOf(rigOf(smallFace())).json.contains("extensions"));
}

TEST(ChosenMeshes, LeaveOtherExtensionsAsTheyAre) {
  Glb glb = character();
  glb.json["extensions"]["TEST_unknown"] = {{"kept", true}};
  EXPECT_EQ(write(rigOf(glb)).json["extensions"], glb.json["extensions"]);
}

/// Meshes that are not part of the face are as they were, targets included.
TEST(ChosenMeshes, LeaveOthersAsTheyAre) {
  const Glb source = character();
  const Written before(source.bytes()), after = write(rigOf(source, {"Face"}));
  for (const std::size_t mesh : {1u, 2u, 3u}) {
    EXPECT_EQ(after.vectors(after.attribute("POSITION", mesh)),
              before.vectors(before.attribute("POSITION", mesh)));
    EXPECT_EQ(after.json["meshes"][mesh], [&] {
      Json expected = before.json["meshes"][mesh];
      Json& primitive = expected["primitives"][0];
      primitive["attributes"] = after.primitive(mesh)["attributes"];
      return expected;
    }());
  }
  EXPECT_EQ(after.vectors(after.morph(1, "POSITION", 2)),
            before.vectors(before.morph(1, "POSITION", 2)));
}

/// The surface moves a rim by up to the tolerance in a target that one of two meshes lacks.
TEST(ChosenMeshes, StayTogetherWhereTheyMeet) {
  Glb glb = smallFace();
  std::vector<Vec3> away = sheetPositions(), deltas = openDeltas();
  for (Vec3& p : away) p = {p.x - 2, p.y, 0.25 * (2 - p.x) * p.y};
  for (std::size_t v = 0; v < 9; v += 3) deltas[v] = {};  // where they meet
  glb.primitive()["targets"][0]["POSITION"] = glb.addVectors(deltas);
  Json body = glb.primitive();
  body.erase("targets");
  body["attributes"]["POSITION"] = glb.addVectors(away);
  glb.add("nodes",
          {{"mesh", glb.add("meshes", {{"name", "body"}, {"primitives", Json::array({body})}})}});
  const RigSource source = chosen(glb, {"head", "body"});
  Rig rig = converted(source.rig, 0.05);
  rig.scene = source.scene;
  ASSERT_EQ(rig.source.gridVertex[0], rig.source.gridVertex[11]);
  for (Target& target : rig.targets)  // as if it were packed
    for (Vec3& difference : target.difference) difference += {0.02, 0, 0};
  const Written out = write(rig, {.morphNormals = true});
  for (const char* attribute : {"POSITION", "NORMAL"}) {
    const std::vector<Vec3> moved = out.vectors(out.morph(0, attribute));
    for (std::size_t v = 0; v < 9; v += 3) EXPECT_EQ(moved[v], Vec3{}) << attribute;
    EXPECT_NE(moved[4], Vec3{}) << attribute;
  }
}

TEST(ChosenMeshes, OfADamagedSceneAreRefused) {
  for (const Json& choice : {Json("all"), Json::object({{"meshes", 1}}),
                             Json::object({{"meshes", {4}}}), Json::object({{"meshes", {-1}}})}) {
    Glb glb = character();
    glb.json["extensions"]["SWEEPFACE_face"] = choice;
    EXPECT_TRUE(refused(glb, {"extension SWEEPFACE_face"})) << choice;
  }
}

// ---- What others of the same names do ----

TEST(MovedTargets, OfOtherMeshesAreShownLikeThoseOfTheSameNames) {
  const Rig rig = rigOf(character(), {"Face"});
  Weights weights(2, 0.0);
  weights[rig.find("open")] = 0.75;
  const Json meshes = write(rig, {.weights = weights}).json["meshes"];
  EXPECT_EQ(meshes[0]["weights"], Json({0.75, 0.0}));
  EXPECT_EQ(meshes[1]["weights"], Json::array({0.75}));
  EXPECT_EQ(meshes[2]["weights"], Json({0.75, 0.25})) << "its own target stays";
  EXPECT_FALSE(meshes[3].contains("weights"));
}

TEST(MovedTargets, OfOtherMeshesMoveLikeThoseOfTheSameNames) {
  Glb source = character();
  source.add("nodes", {{"mesh", 2}, {"weights", {0.5, 0.5}}});
  const Rig rig = rigOf(source, {"Face"});
  Weights goal(2, 0.0);
  goal[rig.find("open")] = 1;
  const Motion motion = *Motion::make(Weights(2, 0.0), goal, TimeLaw::newton, 1);
  const Written glb = write(rig, {.motion = &motion});
  const Json& animation = glb.json["animations"][0];
  std::map<std::size_t, std::vector<double>> found;  // by node
  for (const Json& channel : animation["channels"])
    found[channel["target"]["node"]] = evaluate(glb, animation, channel["sampler"], 0.5);
  using Values = std::vector<double>;
  EXPECT_EQ(found, (std::map<std::size_t, Values>{{0, Values{0.25, 0}},
                                                  {1, Values{0.25}},
                                                  {3, Values{0.25, 0.25}},
                                                  {5, Values{0.25, 0.5}}}));
}

/// Weights that are not one for each target mean nothing.
TEST(MovedTargets, RestOnlyAtWeightsOfAll) {
  Glb source = character();
  source.json["nodes"][3]["weights"] = {0.5};
  const Rig rig = rigOf(source, {"Face"});
  const Written glb = write(rig, {.weights = {0.75, 0}});
  EXPECT_EQ(glb.json["nodes"][3]["weights"], Json::array({0.5}));
  EXPECT_EQ(glb.json["meshes"][2]["weights"], Json({0.75, 0.25}));
}

TEST(MovedTargets, OfOtherMeshesWithoutNamesStay) {
  Glb source = character();
  source.json["meshes"][2]["extras"]["targetNames"].push_back("one too many");
  source.json["meshes"][0].erase("extras");
  source.json["meshes"][1].erase("extras");
  const Rig rig = rigOf(source, {"Face"});
  ASSERT_EQ(rig.targetNames(), (Names{"target_0", "target_1"}));
  const Json meshes = write(rig, {.weights = {0.5, 0.5}}).json["meshes"];
  EXPECT_EQ(meshes[0]["weights"], Json({0.5, 0.5}));
  EXPECT_FALSE(meshes[1].contains("weights"));
  EXPECT_EQ(meshes[2]["weights"], Json({0.0, 0.25}));
}

}  // namespace
}  // namespace sweepface
