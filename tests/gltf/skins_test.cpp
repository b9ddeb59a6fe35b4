// Meshes whose vertices are stored elsewhere than where their skins show them.
#include "gltf/skins.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

struct Joint {
  Vec3 place;
  double size = 1;
  double turn = 0;  // about z
};

Json nodeOf(const Joint& joint) {
  const Vec3& p = joint.place;
  return {{"translation", {p.x, p.y, p.z}},
          {"rotation", {0, 0, std::sin(joint.turn / 2), std::cos(joint.turn / 2)}},
          {"scale", {joint.size, joint.size, joint.size}}};
}

/// Inverse bind matrices that show p at size · p + shift if the joints are only translated.
std::vector<float> bindingOf(const std::vector<Joint>& joints, double size, const Vec3& shift) {
  std::vector<float> numbers;
  for (const Joint& joint : joints) {
    const Vec3 t = shift - joint.place;
    for (const double number :
         {size, 0.0, 0.0, 0.0, 0.0, size, 0.0, 0.0, 0.0, 0.0, size, 0.0, t.x, t.y, t.z, 1.0})
      numbers.push_back(static_cast<float>(number));
  }
  return numbers;
}

/// Binds each of the nine vertices of the sheet to a joint.
void hang(Glb& glb, std::size_t mesh, const std::vector<std::uint8_t>& jointsOfVertices) {
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (const std::uint8_t joint : jointsOfVertices) {
    joints.insert(joints.end(), {joint, 0, 0, 0});
    weights.insert(weights.end(), {1, 0, 0, 0});
  }
  Json& attributes = glb.primitive(mesh)["attributes"];
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  attributes["WEIGHTS_0"] = glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "VEC4", 9);
}
const std::vector<std::uint8_t> kOnFirst(9, 0), kMostOnSecond{0, 0, 1, 1, 1, 1, 1, 1, 1};

/// Gives the node of a mesh a skin of its own, of these joints. Returns the skin's index.
std::size_t addSkin(Glb& glb, std::size_t node, const std::vector<Joint>& joints,
                    const std::vector<float>& binding) {
  Json numbers = Json::array();
  for (const Joint& joint : joints) numbers.push_back(glb.add("nodes", nodeOf(joint)));
  const std::size_t matrices =
      glb.addAccessor(glb.addView(bytesOf(binding)), 5126, "MAT4", binding.size() / 16);
  const std::size_t skin =
      glb.add("skins", {{"joints", std::move(numbers)}, {"inverseBindMatrices", matrices}});
  glb.json["nodes"][node]["skin"] = skin;
  return skin;
}

const std::vector<Joint> kJoints{{{2, 0, 0}}, {{2, 3, 0}}};

/// The sheet in steps of 1/64, which a skin scales back and shows moved by `away`.
Glb quantizedFace(const Vec3& away = {}) {
  Glb glb = smallFace();
  std::vector<std::int16_t> steps, deltas;
  for (const Vec3& p : sheetPositions())
    for (const double x : {p.x, p.y, p.z, 0.0}) steps.push_back(static_cast<std::int16_t>(64 * x));
  for (const Vec3& d : openDeltas())
    for (const double x : {d.x, d.y, d.z, 0.0}) deltas.push_back(static_cast<std::int16_t>(64 * x));
  glb.primitive()["attributes"]["POSITION"] =
      glb.addAccessor(glb.addView(bytesOf(steps), 8), 5122, "VEC3", 9);
  const std::size_t open = glb.addAccessor(glb.addView(bytesOf(deltas), 8), 5122, "VEC3", 9);
  glb.primitive()["targets"] = Json::array({Json::object({{"POSITION", open}})});
  glb.json["meshes"][0]["extras"]["targetNames"] = {"open"};
  hang(glb, 0, kOnFirst);
  addSkin(glb, 0, kJoints, bindingOf(kJoints, 1.0 / 64, away));
  return glb;
}

std::vector<Vec3> moved(std::vector<Vec3> positions, const Vec3& by) {
  for (Vec3& p : positions) p += by;
  return positions;
}

void expectNear(const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t v = 0; v < found.size(); ++v)
    EXPECT_LE(norm(found[v] - expected[v]), 1e-5) << "vertex " << v;
}

/// Where a skin shows a mesh bound to one of its joints, at rest.
std::vector<Vec3> shown(const Written& glb, std::size_t node, std::size_t joint) {
  const std::size_t skin = glb.json["nodes"][node]["skin"], mesh = glb.json["nodes"][node]["mesh"];
  const Json& json = glb.json["skins"][skin];
  const auto m = glb.numbers(json["inverseBindMatrices"]);
  const Json& t = glb.json["nodes"][json["joints"][joint].get<std::size_t>()]["translation"];
  std::vector<Vec3> list = glb.vectors(glb.attribute("POSITION", mesh));
  for (Vec3& p : list) {
    const double* c = &m[16 * joint];
    p = {c[0] * p.x + c[12] + t[0].get<double>(), c[5] * p.y + c[13] + t[1].get<double>(),
         c[10] * p.z + c[14] + t[2].get<double>()};
  }
  return list;
}

TEST(Skins, PlaceWhatTheyAloneUndo) {
  const RigSource source = read(quantizedFace({5, 6, 7}));
  const auto expected = moved(sheetPositions(), {5, 6, 7});
  expectNear(source.rig.neutral.positions, expected);
  std::vector<Vec3> open = expected;
  for (std::size_t v = 0; v < 9; ++v) open[v] += openDeltas()[v];
  expectNear(source.rig.targets[0].positions, open);
  EXPECT_TRUE(source.warnings.empty()) << source.warnings[0];
  EXPECT_TRUE(source.faceWarnings.empty()) << source.faceWarnings[0];
}

TEST(Skins, OfSeveralMeshesPlaceThemInOneScene) {
  Glb glb = quantizedFace({5, 6, 7});
  Json eye = glb.json["meshes"][0];
  eye["name"] = "eye";
  glb.add("meshes", std::move(eye));
  const std::size_t node = glb.add("nodes", {{"mesh", 1}});
  addSkin(glb, node, kJoints, bindingOf(kJoints, 1.0 / 32, {-9, 0, 0}));
  std::vector<Vec3> expected = moved(sheetPositions(), {5, 6, 7});
  for (const Vec3& p : sheetPositions()) expected.push_back(2 * p - Vec3{9, 0, 0});
  expectNear(read(glb).rig.neutral.positions, expected);
}

TEST(Skins, ShowWhatIsWrittenWhereItWas) {
  for (const bool quantize : {false, true}) {
    const Rig rig = converted(quantizedFace({5, 6, 7}));
    const Written glb = write(rig, {.quantize = quantize});
    for (const std::size_t joint : {0u, 1u}) {
      const auto places = shown(glb, 0, joint), surface = surfacePositions(rig);
      ASSERT_EQ(places.size(), surface.size());
      for (std::size_t v = 0; v < places.size(); ++v)
        EXPECT_LE(norm(places[v] - surface[v]), 1e-4) << "vertex " << v;
    }
  }
}

TEST(Skins, OfTheSceneTakeTheirMatricesPlaces) {
  Glb source = quantizedFace({5, 6, 7});
  const std::size_t number = source.json["skins"][0]["inverseBindMatrices"];
  const auto arePlaced = [&] {
    const Written glb = write(converted(source));
    EXPECT_EQ(glb.json["skins"].size(), 1u);
    EXPECT_EQ(glb.json["skins"][0]["inverseBindMatrices"], number);
    EXPECT_EQ(glb.numbers(number),
              (std::vector<double>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0,  0, 1,  //
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, -3, 0, 1}));
  };
  arePlaced();
  // Sparse matrices leave nothing behind.
  const std::string first = bytesOf(bindingOf({kJoints[0]}, 1.0 / 64, {5, 6, 7}));
  const std::size_t where = source.addView(bytesOf(std::vector<std::uint16_t>{0})),
                    what = source.addView(first);
  source.accessor(number)["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", where}, {"componentType", 5123}}},
      {"values", {{"bufferView", what}}}};
  arePlaced();
}

TEST(Skins, ThatShowOtherMeshesTooStayForThem) {
  Glb glb = quantizedFace();
  const std::size_t shirt = glb.add(
      "meshes", {{"primitives",
                  Json::array({{{"attributes", {{"POSITION", glb.addVectors({{}, {}, {}})}}}}})}});
  const std::size_t node = glb.add("nodes", {{"mesh", shirt}, {"skin", 0}});
  const Json before = glb.json["skins"][0];
  const Written written = write(converted(glb));
  ASSERT_EQ(written.json["skins"].size(), 2u);
  EXPECT_EQ(written.json["skins"][0], before);
  EXPECT_EQ(written.numbers(before["inverseBindMatrices"])[0], 1.0 / 64);
  EXPECT_EQ(written.json["nodes"][node]["skin"], 0);
  EXPECT_EQ(written.json["nodes"][0]["skin"], 1);
  EXPECT_EQ(written.numbers(written.json["skins"][1]["inverseBindMatrices"])[0], 1);
}

TEST(Skins, WithoutMatricesPlaceByTheirJoints) {
  Glb glb = smallFace();
  hang(glb, 0, kOnFirst);
  glb.add("nodes", nodeOf({{0, 0, 4}, 2}));
  glb.add("skins", {{"joints", {1}}});
  glb.json["nodes"][0]["skin"] = 0;
  std::vector<Vec3> expected = sheetPositions();
  for (Vec3& p : expected) p = 2 * p + Vec3{0, 0, 4};
  expectNear(read(glb).rig.neutral.positions, expected);
  const Written written = write(converted(glb));
  EXPECT_EQ(written.numbers(written.json["skins"][0]["inverseBindMatrices"]),
            (std::vector<double>{0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, -2, 1}));
}

TEST(Skins, ThatRoundALittlePlaceNothing) {
  Glb glb = smallFace();
  hang(glb, 0, kOnFirst);
  addSkin(glb, 0, kJoints, bindingOf(kJoints, 1 + 2e-6, {1e-6, 0, 0}));
  EXPECT_EQ(read(glb).rig.neutral.positions, sheetPositions());
}

TEST(Skins, ThatScaleALittlePlace) {
  Glb glb = smallFace();
  hang(glb, 0, kOnFirst);
  addSkin(glb, 0, kJoints, bindingOf(kJoints, 1.001, {}));
  std::vector<Vec3> expected = sheetPositions();
  for (Vec3& p : expected) p *= 1.001;
  expectNear(read(glb).rig.neutral.positions, expected);
}

TEST(Skins, PlaceInAFewDifferentWaysOnly) {
  constexpr std::size_t kMeshes = 70, kPlaced = 63;
  std::vector<Joint> joints;
  for (std::size_t k = 0; k < kMeshes; ++k) joints.push_back({{}, 2.0 + static_cast<double>(k)});
  Glb glb = smallFace();
  const std::size_t skin = addSkin(glb, 0, joints, bindingOf(joints, 1, {}));
  std::vector<Vec3> expected;
  for (std::size_t k = 0; k < kMeshes; ++k) {
    if (k > 0) {
      glb.add("meshes", Json(glb.json["meshes"][0]));
      glb.add("nodes", {{"mesh", k}, {"skin", skin}});
    }
    hang(glb, k, std::vector<std::uint8_t>(9, static_cast<std::uint8_t>(k)));
    for (const Vec3& p : sheetPositions())
      expected.push_back((k < kPlaced ? joints[k].size : 1) * p);
  }
  expectNear(read(glb).rig.neutral.positions, expected);
}

/// Two vertices are bound to the first joint, seven to the second.
TEST(Skins, PlaceByTheJointOnWhichMostHangs) {
  for (const double size : {1.0, 0.01}) {
    Glb glb = smallFace();
    hang(glb, 0, kMostOnSecond);
    // Odd joints to which nothing is bound do not count, whatever they are.
    const std::vector<Joint> bound{{{2, 0, 0}}, {{2, 3, 0}}, {{0, 0, 0}}, {{0, 0, 0}}},
        posed{{{2, 0, 9}}, {{2, 3, 0}, 1, 0.5}, {{70, 0, 0}, 1e-4}, {{0, 0, 0}, 0}};
    addSkin(glb, 0, posed, bindingOf(bound, size, {}));
    std::vector<Vec3> expected = sheetPositions();
    for (Vec3& p : expected) {
      const Vec3 q = size * p - Vec3{2, 3, 0};
      p = Vec3{std::cos(0.5) * q.x - std::sin(0.5) * q.y, std::sin(0.5) * q.x + std::cos(0.5) * q.y,
               q.z} +
          Vec3{2, 3, 0};
    }
    expectNear(read(glb).rig.neutral.positions, expected);
  }
}

TEST(Skins, PlaceByTheNextJointWhereTheFirstHidesWhatHangsOnIt) {
  Glb glb = smallFace();
  hang(glb, 0, kMostOnSecond);
  addSkin(glb, 0, {{{2, 0, 0}}, {{2, 3, 0}, 0}}, bindingOf(kJoints, 0.5, {1, 1, 1}));
  std::vector<Vec3> expected = sheetPositions();
  for (Vec3& p : expected) p = 0.5 * p + Vec3{1, 1, 1};
  expectNear(read(glb).rig.neutral.positions, expected);
}

/// An eye hidden by a joint of scale zero is still as large as the rest.
TEST(Skins, PlaceByAnyJointWhatHangsOnNone) {
  Glb glb = smallFace();
  hang(glb, 0, std::vector<std::uint8_t>(9, 1));
  addSkin(glb, 0, {{{2, 0, 0}}, {{2, 3, 0}, 0}}, bindingOf(kJoints, 0.5, {1, 1, 1}));
  std::vector<Vec3> expected = sheetPositions();
  for (Vec3& p : expected) p = 0.5 * p + Vec3{1, 1, 1};
  expectNear(read(glb).rig.neutral.positions, expected);
}

/// Whether faces are flipped depends on whether their node mirrors, wherever a skin places them.
TEST(Skins, ThatMirrorTurnFacesOnlyBelowNodesThatDo) {
  Glb glb = smallFace();
  hang(glb, 0, kOnFirst);
  addSkin(glb, 0, kJoints, bindingOf(kJoints, 1, {}));
  const auto plain = read(glb).rig.neutral.positions;
  const auto normal = [](const MeshRig& rig) {
    const auto at = [&](int k) { return rig.neutral.positions[rig.neutral.polygons.corners[k]]; };
    return cross(at(1) - at(0), at(2) - at(0)).z;
  };
  for (const int node : {1, -1})
    for (const int joint : {1, -1}) {
      glb.json["nodes"][0]["scale"] = {node, 1, 1};
      glb.json["nodes"][1]["scale"] = {joint, 1, 1};
      const RigSource source = read(glb);
      EXPECT_NEAR(source.rig.neutral.positions[2].x, joint > 0 ? plain[2].x : 4 - plain[2].x, 1e-9);
      EXPECT_EQ(normal(source.rig) > 0, node == joint);
      // The written triangles keep their winding.
      const Written written = write(converted(glb));
      const auto positions = written.vectors(written.attribute("POSITION"));
      const auto t = written.numbers(written.primitive()["indices"]);
      const auto at = [&](int k) { return positions[static_cast<std::size_t>(t[k])]; };
      EXPECT_EQ(cross(at(1) - at(0), at(2) - at(0)).z > 0, joint > 0);
    }
}

TEST(Skins, LeaveAMeshAsItStandsThatHasMoreThanTheFace) {
  Glb glb = quantizedFace({5, 6, 7});
  Json& primitives = glb.json["meshes"][0]["primitives"];
  const Json before = glb.json["skins"];
  primitives.push_back({{"mode", 0}, {"attributes", {{"POSITION", glb.addVectors({{}, {}, {}})}}}});
  const RigSource source = read(glb);
  EXPECT_EQ(source.rig.neutral.positions[2].x, 64 * sheetPositions()[2].x);
  EXPECT_FALSE(source.faceWarnings.empty());
  EXPECT_EQ(write(converted(glb)).json["skins"], before);
}

TEST(Skins, AndNodesCountThatAreInScenes) {
  Glb glb = smallFace();
  hang(glb, 0, kOnFirst);
  addSkin(glb, 0, kJoints, bindingOf(kJoints, 0.5, {}));
  const auto placed = read(glb).rig.neutral.positions;
  const std::size_t orphan = glb.add("nodes", {{"mesh", 0}, {"scale", {9, 9, 9}}});
  EXPECT_NE(read(glb).rig.neutral.positions, placed);  // shown in two ways
  glb.json["scenes"] = Json::array({{{"nodes", {0, 1, 2}}}});
  EXPECT_EQ(read(glb).rig.neutral.positions, placed);
  glb.json["scenes"].push_back({{"nodes", {orphan}}});
  EXPECT_NE(read(glb).rig.neutral.positions, placed);
  // The same without skins.
  Glb plain = smallFace();
  const auto own = read(plain).rig.neutral.positions;
  plain.json["nodes"].insert(plain.json["nodes"].begin(), glb.json["nodes"][orphan]);
  EXPECT_NE(read(plain).rig.neutral.positions, own);
  plain.json["scenes"] = Json::array({{{"nodes", {1}}}});
  EXPECT_EQ(read(plain).rig.neutral.positions, own);
}

/// A face and an eye share a skin. Its joints agree, or one of them has moved.
TEST(Skins, AreSharedByMeshesThatTheyPlaceAlike) {
  for (const bool moves : {false, true}) {
    Glb glb = smallFace();
    hang(glb, 0, kOnFirst);
    const Json& face = glb.json["meshes"][0];
    glb.add("meshes", Json(face));
    hang(glb, 1, kMostOnSecond);
    const auto bound = bindingOf(kJoints, 0.1, {});
    const std::size_t skin = addSkin(glb, 0, {{{2, 0, 0}}, {{2, 3, moves ? 1.0 : 1e-6}}}, bound);
    const std::size_t eye = glb.add("nodes", {{"mesh", 1}, {"skin", skin}});
    const Written written = write(converted(glb));
    EXPECT_EQ(written.json["skins"].size(), moves ? 2u : 1u);
    const auto positions = [&](std::size_t mesh) {
      return written.vectors(written.attribute("POSITION", mesh));
    };
    for (std::size_t v = 0; v < 9; ++v)
      EXPECT_LE(norm(positions(1)[v] - positions(0)[v] - Vec3{0, 0, moves ? 1.0 : 0.0}), 1e-4);
    for (const std::size_t node : {std::size_t{0}, eye}) {
      const auto places = shown(written, node, node == 0 ? 0 : 1);
      for (std::size_t v = 0; v < 9; ++v)
        EXPECT_LE(norm(places[v] - positions(node == 0 ? 0 : 1)[v]), 1e-5) << "vertex " << v;
    }
  }
}

/// A mesh that could be placed in more than one way, or in none, stays where it is.
TEST(Skins, ThatCannotPlaceLeaveAMeshAsItStands) {
  const std::vector<std::function<void(Glb&)>> faults{
      [](Glb& glb) { glb.add("nodes", {{"mesh", 0}}); },
      [](Glb& glb) {
        const std::size_t node = glb.add("nodes", {{"mesh", 0}});
        addSkin(glb, node, kJoints, bindingOf(kJoints, 3, {}));
      },
      [](Glb& glb) { glb.json["nodes"][1]["scale"] = glb.json["nodes"][2]["scale"] = {0, 1, 1}; },
      [](Glb& glb) { glb.json["skins"][0]["joints"] = {1, 2, 1}; },
      [](Glb& glb) {
        auto odd = bindingOf(kJoints, 3, {});
        odd[3] = 0.25;  // in the last row
        glb.json["skins"][0]["inverseBindMatrices"] =
            glb.addAccessor(glb.addView(bytesOf(odd)), 5126, "MAT4", kJoints.size());
      },
      [](Glb& glb) {
        const auto many = bindingOf(std::vector<Joint>(300), 3, {});
        glb.json["skins"][0]["inverseBindMatrices"] =
            glb.addAccessor(glb.addView(bytesOf(many)), 5126, "MAT4", 300);
      },
      [](Glb& glb) { glb.json["skins"][0]["inverseBindMatrices"] = glb.addVectors({{}, {}}); }};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    Glb glb = smallFace();
    hang(glb, 0, kOnFirst);
    addSkin(glb, 0, kJoints, bindingOf(kJoints, 0.25, {1, 1, 1}));
    faults[k](glb);
    EXPECT_EQ(read(glb).rig.neutral.positions, sheetPositions()) << "fault " << k;
  }
}

}  // namespace
}  // namespace sweepface
