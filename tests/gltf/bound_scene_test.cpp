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

const std::vector<std::uint16_t> quad{0, 1, 4, 0, 4, 3}, turned{0, 4, 1, 0, 3, 4};
const Loop front{0, 1, 4, 3}, backward{0, 3, 4, 1};

TEST(BoundScene, FindsThePartsOfFacesByTheirNumbers) {
  EXPECT_EQ(facePartsOf(faceOf({quad, turned}), {front, backward}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({quad, {0, 3, 1}}), {front, {0, 3, 1}}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({{0, 4, 1}, quad}), {{0, 4, 1}, front}), (std::vector<Index>{0, 1}));
  EXPECT_EQ(facePartsOf(faceOf({quad, {0, 0, 0}, {1, 2, 5}}), {front, {1, 2, 5}}),
            (std::vector<Index>{0, 2}));
}

TEST(BoundScene, RefusesFacesOfOtherPartsThanItsOwn) {
  const Glb two = faceOf({quad, {1, 2, 5}});
  const auto refuses = [&](const std::vector<Loop>& faces, std::string_view why) {
    EXPECT_TRUE(failsWith(gltf::sceneOf(rigOf(two, faces)), {why}));
  };
  refuses({{0, 1, 4}, front}, "face 1 is in no mesh of it");
  refuses({front, {1, 2, 5}, {4, 5, 8}}, "face 2 is in no mesh of it");
  refuses({front}, "it has more triangles");
  Glb apart = smallFace();
  apart.json["meshes"].push_back(apart.json["meshes"][0]);
  std::vector<Loop> faces(2 * sheetIndices().size() / 3, {0, 1, 4});
  EXPECT_TRUE(failsWith(gltf::sceneOf(rigOf(apart, faces)), {"face 8 is in no mesh of it"}));
}

/// A rig's shapes account for as many elements as it has vertices, so its file may claim them.
TEST(BoundScene, AttributesWithoutDataMayBeAsLongAsTheFaceIs) {
  constexpr int count = 120'000;
  std::vector<Vec3> positions;
  for (int v = 0; v < count; ++v) positions.push_back({1.0 * v, 1.0 * (v % 3), 0});
  Glb glb;
  const std::size_t color =
      glb.add("accessors", {{"componentType", 5126}, {"type", "VEC4"}, {"count", count}});
  const Json attributes{{"POSITION", glb.addVectors(positions)}, {"COLOR_0", color}};
  glb.add("meshes", {{"primitives", Json::array({{{"attributes", attributes}}})}});
  std::vector<Loop> faces;
  for (Index v = 0; v < count; v += 3) faces.push_back({v, v + 1, v + 2});
  const auto scene = gltf::sceneOf(rigOf(glb, faces));
  ASSERT_TRUE(scene) << scene.error().message;
  const auto accessor = gltf::accessorAt(scene->document, color);
  EXPECT_TRUE(gltf::decode(scene->document, *accessor));
}

}  // namespace
}  // namespace sweepface
