#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The small face, `turned` of whose nine vertices have their normal to the other side.
std::vector<std::string> warningsWith(std::size_t turned, const Json& node) {
  Glb glb = smallFace();
  std::vector<Vec3> normals(9, Vec3{0, 0, 1});
  std::fill_n(normals.begin(), turned, Vec3{0, 0, -1});
  glb.primitive()["attributes"]["NORMAL"] = glb.addVectors(normals);
  glb.json["nodes"][0].update(node);
  return read(glb).faceWarnings;
}

TEST(LostNormals, AreThoseFarFromTheTriangles) {
  EXPECT_TRUE(warningsWith(0, Json::object()).empty());
  EXPECT_EQ(warningsWith(4, Json::object()),
            std::vector<std::string>{
                "At 4 of 9 places the vertices have normals more than 45 degrees from those of the "
                "triangles around them (made for shading, or the triangles look inwards): the "
                "surface has normals of its own."});
}

TEST(LostNormals, AreNoneWhereANodeTurnsMirrorsOrStretchesTheFace) {
  for (const char* node : {R"({"rotation": [1, 0, 0, 0]})", R"({"scale": [-1, 1, 1]})",
                           R"({"scale": [1, 1, 0.01], "rotation": [0, 0.6, 0, 0.8]})"}) {
    EXPECT_TRUE(warningsWith(0, Json::parse(node)).empty()) << node;
    EXPECT_EQ(warningsWith(9, Json::parse(node)).size(), 1u) << node;
  }
}

}  // namespace
}  // namespace sweepface
