#include <gtest/gtest.h>

#include "sweepface/usd.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(LeftOutOfUsd, AreOtherMeshesSkinsAnimationsAndColours) {
  EXPECT_EQ(leftOutOfUsd({}), "");
  EXPECT_EQ(leftOutOfUsd(converted(smallFace())), "");
  Glb glb = smallFace();
  Json body = glb.primitive();
  body.erase("targets");
  glb.add("meshes", {{"primitives", Json::array({body})}});
  glb.add("nodes", {{"mesh", 1}});
  EXPECT_EQ(
      leftOutOfUsd(converted(glb)),
      "A USD file leaves out other meshes or copies of the scene that the face came with; a .glb "
      "keeps them.");
  glb.primitive()["attributes"]["COLOR_0"] = glb.addVectors(std::vector<Vec3>(9, {1, 0, 0}));
  glb.add("skins", {{"joints", {1}}});
  glb.add(
      "animations",
      {{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "scale"}}}}})},
       {"samplers",
        Json::array({{{"input", glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0})), 5126,
                                                "SCALAR", 1)},
                      {"output", glb.addVectors({{1, 1, 1}})}}})}});
  EXPECT_EQ(leftOutOfUsd(converted(glb)),
            "A USD file leaves out other meshes or copies and skins and animations and colours of "
            "vertices of the scene that the face came with; a .glb keeps them.");
}

}  // namespace
}  // namespace sweepface
