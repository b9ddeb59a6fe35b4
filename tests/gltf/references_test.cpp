// What the rig does not use is passed on unread, but what it refers to must exist.
#include "gltf/references.hpp"

#include <fmt/format.h>
#include <functional>
#include <limits>

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// Expects a refusal. A reference to what does not exist could become valid once something is
/// added.
void expectRefused(const Glb& glb, std::string_view words) {
  const auto source = parseGltf(glb.bytes(), "face.glb", {});
  ASSERT_FALSE(source.has_value());
  EXPECT_NE(source.error().message.find(words), std::string::npos) << source.error().message;
}

TEST(References, WhatIsPassedOnNamesAccessorsThatExist) {
  Glb glb = smallFace();
  const std::size_t count = glb.json["accessors"].size();
  glb.add("meshes", {{"primitives", {{{"mode", 0}, {"attributes", {{"COLOR_0", count}}}}}}});
  expectRefused(
      glb, fmt::format("'COLOR_0' names an accessor that does not exist (there are {})", count));
  glb = smallFace();
  glb.json["skins"] = {{{"inverseBindMatrices", 99}}};
  expectRefused(glb, "'inverseBindMatrices' names an accessor that does not exist");
}

TEST(References, WhatIsPassedOnNamesViewsThatExist) {
  Glb glb = smallFace();
  const std::size_t unused = glb.json["accessors"].size(), views = glb.json["bufferViews"].size();
  glb.json["accessors"].push_back(
      {{"bufferView", views}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", 1}});
  expectRefused(glb, fmt::format("accessors {}: its bufferView does not exist", unused));
  glb = smallFace();
  glb.json["images"] = {{{"bufferView", views}, {"mimeType", "image/png"}}};
  expectRefused(glb, "images 0: its bufferView does not exist");
}

/// The small face on a joint, in a scene, with an animation of both.
Glb animatedFace() {
  Glb glb = smallFace();
  const std::size_t joint = glb.add("nodes", Json::object());
  glb.json["skins"] = {{{"joints", {joint}}}};
  glb.json["nodes"][0]["skin"] = 0;
  glb.json["scenes"] = {{{"nodes", {0, joint}}}};
  glb.json["scene"] = 0;
  const std::vector<std::uint8_t> joints(36, 0);
  std::vector<float> weights;
  for (int v = 0; v < 9; ++v) weights.insert(weights.end(), {1, 0, 0, 0});
  Json& attributes = glb.primitive()["attributes"];
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  attributes["WEIGHTS_0"] = glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "VEC4", 9);
  const std::vector<float> times{0, 1}, values{0, 1}, ways(6, 0.5f);
  const std::size_t input = glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", 2),
                    moves = glb.addAccessor(glb.addView(bytesOf(ways)), 5126, "VEC3", 2),
                    opens = glb.addAccessor(glb.addView(bytesOf(values)), 5126, "SCALAR", 2);
  glb.json["animations"] = {
      {{"samplers", {{{"input", input}, {"output", moves}}, {{"input", input}, {"output", opens}}}},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", joint}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return glb;
}

TEST(References, OfASoundFileAreTaken) {
  EXPECT_TRUE(parseGltf(animatedFace().bytes(), "face.glb", {}).has_value());
}

TEST(References, WhatIsPassedOnNamesWhatThereIs) {
  struct Fault {
    std::function<void(Json&)> make;
    std::string_view words;
  };
  const std::vector<Fault> faults{
      {[](Json& j) { j["scene"] = 5; }, "its root: 'scene' is 5, but the file has 1 scenes"},
      {[](Json& j) { j["scenes"][0]["nodes"] = {9}; },
       "scene 0: one of its nodes is none of the 2"},
      {[](Json& j) { j["nodes"][0]["skin"] = 3; }, "node 0: 'skin' is 3, but the file has 1 skins"},
      {[](Json& j) { j["nodes"][1]["camera"] = 0; }, "node 1: 'camera' is 0"},
      {[](Json& j) { j["textures"] = {{{"source", 0}}}; }, "texture 0: 'source' is 0"},
      {[](Json& j) { j["textures"] = {{{"sampler", 0}}}; }, "texture 0: 'sampler' is 0"},
      {[](Json& j) { j["nodes"][1]["mesh"] = 4; }, "node 1: 'mesh' is 4"},
      {[](Json& j) { j["skins"][0]["skeleton"] = 9; }, "skin 0: 'skeleton' is 9"},
      {[](Json& j) { j["meshes"].push_back({{"primitives", {{{"material", 9}}}}}); },
       "mesh 1: 'material' is 9"},
      {[](Json& j) { j["skins"][0]["joints"] = {1, 77}; }, "skin 0: one of its joints is none"},
      {[](Json& j) { j["skins"][0]["joints"] = Json::array(); },
       "mesh 0: a vertex hangs on joint 0 of skin 0, which has 0"},
      {[](Json& j) { j["animations"][0]["channels"][0]["target"]["node"] = 9; },
       "animation 0, channel 0: 'node' is 9"},
      {[](Json& j) { j["animations"][0]["channels"][1]["sampler"] = 4; },
       "animation 0, channel 1: 'sampler' is 4"},
      {[](Json& j) { j["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; },
       "animation 0, sampler 0: it has 2 values for 2 keys"},
      {[](Json& j) {
         j["animations"][0]["channels"][1]["target"]["path"] = "scale";
         j["accessors"][j["animations"][0]["samplers"][1]["output"].get<int>()]["count"] = 1;
       },
       "animation 0, sampler 1: it has 1 values for 2 keys"},
      {[](Json& j) {
         j["accessors"][j["animations"][0]["samplers"][1]["output"].get<int>()]["count"] = 3;
       },
       "animation 0, sampler 1: it has 3 values for 2 keys"}};
  for (const auto& [make, words] : faults) {
    Glb glb = animatedFace();
    make(glb.json);
    expectRefused(glb, words);
  }
}

TEST(References, SkinsHaveMatricesThatAreFinite) {
  Glb glb = animatedFace();
  std::vector<float> matrix(16, 0);
  matrix[5] = std::numeric_limits<float>::quiet_NaN();
  const std::size_t accessor = glb.addAccessor(glb.addView(bytesOf(matrix)), 5126, "MAT4", 1);
  glb.json["skins"][0]["inverseBindMatrices"] = accessor;
  expectRefused(glb, fmt::format("accessor {}: element 0 is not finite", accessor));
}

TEST(References, MatricesMayNotClaimMoreThanTheFileCanMean) {
  Glb glb = animatedFace();
  glb.json["skins"][0]["inverseBindMatrices"] = glb.add(
      "accessors", {{"componentType", 5126}, {"type", "MAT4"}, {"count", std::size_t{1} << 40}});
  EXPECT_TRUE(parseGltf(glb.bytes(), "face.glb", {}).has_value());  // they are not read
}

/// Exporters leave joint numbers where the weight is zero.
TEST(References, JointsWithoutWeightMayBeAny) {
  Glb glb = animatedFace();
  std::vector<std::uint8_t> joints(36, 0);
  joints[1] = 200;
  Json& attributes = glb.primitive()["attributes"];
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  EXPECT_TRUE(parseGltf(glb.bytes(), "face.glb", {}).has_value());
  joints[0] = 200;
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  expectRefused(glb, "mesh 0: a vertex hangs on joint 200 of skin 0, which has 1");
}

}  // namespace
}  // namespace sweepface
