#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The small face and `count` meshes without morph targets, each on a node of its own.
Glb withHats(int count) {
  Glb glb = smallFace();
  Json hat = glb.primitive();
  hat.erase("targets");
  for (int k = 0; k < count; ++k)
    glb.add("nodes", {{"mesh", glb.add("meshes", {{"name", "hat" + std::to_string(k)},
                                                  {"primitives", Json::array({hat})}})}});
  return glb;
}

TEST(LeftOut, AreMeshesWithoutTargets) {
  EXPECT_TRUE(read(smallFace()).warnings.empty());
  EXPECT_EQ(
      read(withHats(1)).warnings,
      (std::vector<std::string>{
          "Meshes without morph targets, lines and points are not part of the face: mesh 1 "
          "'hat0'; a .glb of the face shows them, and so do scenes in three.js and Babylon.js; "
          "pictures and .obj files do not."}));
  const auto warnings = read(withHats(5)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("mesh 1 'hat0', mesh 2 'hat1', mesh 3 'hat2' and 2 more;"),
            std::string::npos);
}

TEST(LeftOut, ArePrimitivesWithoutTargets) {
  Glb glb = smallFace();
  Json hat = glb.primitive();
  hat.erase("targets");
  glb.json["meshes"][0]["primitives"].push_back(hat);
  const auto warnings = read(glb).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("not part of the face: mesh 0 'head', primitive 1;"),
            std::string::npos)
      << warnings[0];
}

TEST(LeftOut, ArePrimitivesOfLines) {
  Glb glb = smallFace();
  Json lines = glb.primitive();
  lines["mode"] = 1;
  glb.json["meshes"][0]["primitives"].push_back(lines);
  const auto warnings = read(glb).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("lines and points are not part of the face: mesh 0 'head', primitive"),
            std::string::npos);
}

TEST(LeftOut, AreNoMeshesThatNoSceneShows) {
  Glb glb = withHats(1);
  glb.add("scenes", {{"nodes", Json::array({0})}});
  EXPECT_TRUE(read(glb).warnings.empty());
}

TEST(LeftOut, AreOtherNodesOfAMesh) {
  Glb glb = smallFace();
  glb.add("nodes", {{"mesh", 0}, {"scale", {-1, 1, 1}}});
  const auto warnings = read(glb).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("Meshes that several nodes show are part of the face once, where the "
                             "first one stands: mesh 0 'head';"),
            0u);
}

TEST(LeftOut, AreNamesOfTargets) {
  Glb glb = smallFace();
  const auto warningsWith = [&](const Json& names) {
    glb.json["meshes"][0]["extras"]["targetNames"] = names;
    return read(glb).warnings;
  };
  for (const Json& names : {Json::array({"open"}), Json::array({"open", " "})})
    EXPECT_EQ(warningsWith(names),
              (std::vector<std::string>{"mesh 0 'head': 1 of its 2 morph targets have no name in "
                                        "targetNames, and are called by their numbers."}));
  glb.json["meshes"][0].erase("extras");
  EXPECT_TRUE(read(glb).warnings.empty()) << "nobody meant to name them";
}

}  // namespace
}  // namespace sweepface
