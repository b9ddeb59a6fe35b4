#include "gltf/bound_scene.hpp"

#include "gltf/accessor.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// The small face's rig, with its scene and these faces.
Rig rigOf(const Glb& glb, const std::vector<Loop>& faces) {
  RigSource source = read(glb);
  Rig rig;
  for (const MeshTarget& target : source.rig.targets) rig.targets.emplace_back(target.name);
  rig.scene = std::move(source.scene);
  rig.source.gridVertex.resize(source.rig.neutral.positions.size());
  for (const Loop& face : faces) {
    rig.source.polygons.corners.insert(rig.source.polygons.corners.end(), face.begin(), face.end());
    rig.source.polygons.faceStart.push_back(static_cast<Index>(rig.source.polygons.corners.size()));
  }
  return rig;
}

std::vector<Index> facePartsOf(const Glb& glb, const std::vector<Loop>& faces) {
  const auto scene = gltf::sceneOf(rigOf(glb, faces));
  if (!scene) ADD_FAILURE() << scene.error().message;
  return scene ? scene->facePart : std::vector<Index>{};
}

/// Primitives that share the vertices of the small face.
Glb faceOf(const std::vector<std::vector<std::uint16_t>>& primitives) {
  Glb glb = smallFace();
  const Json primitive = glb.primitive();
  glb.json["meshes"][0]["primitives"] = Json::array();
  for (const std::vector<std::uint16_t>& indices : primitives) {
    Json& added = glb.json["meshes"][0]["primitives"].emplace_back(primitive);
    added["indices"] = glb.addIndices(indices);
  }
  return glb;
}

const Loop front{0, 1, 4, 3}, backward{0, 3, 4, 1};

TEST(BoundScene, FindsThePartsOfQuadsUponEachOther) {
  const std::vector<std::uint16_t> across{0, 1, 4, 0, 4, 3}, behind{0, 4, 1, 0, 3, 4},
      other{0, 3, 1, 1, 3, 4};
  EXPECT_EQ(facePartsOf(faceOf({across, behind}), {front, backward}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({across, other}), {front, backward}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({other, across}), {backward, front}), (std::vector<Index>{0, 1}));
}

TEST(BoundScene, FindsThePartsOfTrianglesUponQuads) {
  const std::vector<std::uint16_t> quad{0, 1, 4, 0, 4, 3};
  EXPECT_EQ(facePartsOf(faceOf({quad, {0, 3, 1}}), {front, {0, 3, 1}}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({quad, {0, 4, 1}}), {front, {0, 4, 1}}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({{0, 4, 1}, quad}), {{0, 4, 1}, front}), (std::vector<Index>{0, 1}));
}

TEST(BoundScene, FindsQuadsWhoseHalvesAreInTwoParts) {
  EXPECT_EQ(facePartsOf(faceOf({{0, 1, 4}, {0, 4, 3, 1, 2, 5}}), {front, {1, 2, 5}}),
            (std::vector<Index>{0, 1}));
}

TEST(BoundScene, RefusesFacesThatAreInNoPart) {
  const Rig rig = rigOf(faceOf({{0, 1, 4}, {0, 4, 3}}), {{0, 1, 4}, {4, 5, 8}});
  EXPECT_TRUE(failsWith(gltf::sceneOf(rig), {"face 1 is in no mesh of it"}));
}

/// The shapes that a rig stands for let its file claim as much as it has vertices.
TEST(BoundScene, AttributesWithoutDataMayBeAsLongAsTheFaceIs) {
  constexpr int count = 120'000;
  std::vector<Vec3> positions;
  for (int v = 0; v < count; ++v) positions.push_back({1.0 * v, 1.0 * (v % 3), 0});
  Glb glb;
  const std::size_t color =
      glb.add("accessors", {{"componentType", 5126}, {"type", "VEC4"}, {"count", count}});
  const Json attributes{{"POSITION", glb.addVectors(positions)}, {"COLOR_0", color}};
  glb.add("meshes", {{"primitives", Json::array({{{"attributes", attributes}}})}});
  const auto scene = gltf::sceneOf(rigOf(glb, {}));
  ASSERT_TRUE(scene) << scene.error().message;
  const auto accessor = gltf::accessorAt(scene->document, color);
  EXPECT_TRUE(gltf::decode(scene->document, *accessor));
}

}  // namespace
}  // namespace sweepface
