#include <functional>

#include "allocations.hpp"
#include "gltf/glb.hpp"
#include "gltf/scene.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The peak memory of reading, beyond what was allocated before.
std::size_t memoryOf(const std::string& bytes, bool accepted = false) {
  const std::size_t before = allocations.held;
  allocations.most = before;
  const auto source = parseGltf(bytes, "face.glb", {});
  EXPECT_EQ(source.has_value(), accepted) << (source ? "" : source.error().message);
  EXPECT_TRUE(source || failsWith(source, {"face.glb: "}));
  return allocations.most - before;
}

constexpr std::size_t kLittle = 200'000;
constexpr std::size_t kMany = 4'000'000'000;

TEST(Hostile, CountsWithoutDataCostNothing) {
  for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
    Glb glb = smallFace();
    Json& accessor = glb.attribute(name);
    accessor.erase("bufferView");
    accessor["count"] = kMany;
    EXPECT_LT(memoryOf(glb.bytes()), kLittle) << name;
  }
  Glb glb = smallFace();
  for (auto& accessor : glb.json["accessors"]) {
    accessor.erase("bufferView");
    accessor["count"] = kMany;
  }
  EXPECT_LT(memoryOf(glb.bytes()), kLittle);
}

TEST(Hostile, SparseCountsCostNothing) {
  Glb glb = smallFace();
  const std::size_t sparse = glb.addSparse(kMany, {1, 2}, {{1, 2, 3}, {4, 5, 6}});
  glb.primitive()["attributes"]["POSITION"] = sparse;
  glb.primitive()["targets"] = Json::array({{{"POSITION", sparse}}});
  glb.primitive()["targets"] = Json::array({Json::object({{"POSITION", sparse}})});
  glb.primitive()["attributes"].erase("NORMAL");
  glb.primitive()["attributes"].erase("TEXCOORD_0");
  EXPECT_LT(memoryOf(glb.bytes()), kLittle);
  glb.primitive().erase("indices");
  EXPECT_LT(memoryOf(glb.bytes()), kLittle);
}

TEST(Hostile, IndicesWithoutDataCostNothing) {
  Glb glb = smallFace();
  Json& indices = glb.accessor(glb.primitive()["indices"].get<std::size_t>());
  indices.erase("bufferView");
  indices["count"] = kMany;
  EXPECT_LT(memoryOf(glb.bytes()), kLittle);
}

TEST(Hostile, CompressedCountsCostNothing) {
  Glb glb = smallFace();
  const std::size_t view = glb.addView(std::string(64, '\xA0'));
  for (const char* mode : {"ATTRIBUTES", "TRIANGLES", "INDICES"}) {
    glb.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteLength", 64},
        {"byteStride", 4},
        {"mode", mode},
        {"count", 3'000'000'000}};
    EXPECT_LT(memoryOf(glb.bytes()), kLittle) << mode;
  }
}

/// Triangles of many vertices, after `change` made them claim much in few bytes.
Glb manyVertices(const std::function<void(Glb&)>& change) {
  Glb glb;
  std::vector<Vec3> positions;
  for (int k = 0; k < 3000; ++k) positions.push_back({1.0 * k, 1.0 * (k % 7), 1.0 * (k % 11)});
  Json primitive = {{"attributes", {{"POSITION", glb.addVectors(positions)}}}};
  glb.add("meshes", {{"primitives", Json::array({primitive})}});
  change(glb);
  return glb;
}

/// Expects them to be refused without taking much memory.
void expectRefusedSoon(const std::function<void(Glb&)>& change) {
  const std::string bytes = manyVertices(change).bytes();
  EXPECT_LT(memoryOf(bytes), 2'000'000 + 2000 * bytes.size());
}

TEST(Hostile, VeryManyEmptyTargetsAreRefused) {
  expectRefusedSoon([](Glb& glb) {
    Json& targets = glb.primitive()["targets"];
    for (int k = 0; k < 20'000; ++k) targets.push_back(Json::object());
  });
}

TEST(Hostile, VeryManyPrimitivesOfTheSameDataAreRefused) {
  expectRefusedSoon([](Glb& glb) {
    const Json mesh = glb.json["meshes"][0];
    for (int k = 0; k < 20'000; ++k) glb.add("meshes", mesh);
  });
  expectRefusedSoon([](Glb& glb) {
    const Json primitive = glb.primitive();
    for (int k = 0; k < 20'000; ++k) glb.json["meshes"][0]["primitives"].push_back(primitive);
  });
}

TEST(Hostile, VeryManyTextureCoordinatesOfTheSameDataAreRefused) {
  expectRefusedSoon([](Glb& glb) {
    const std::size_t view = glb.addView(std::string(3000 * 8, '\0'));
    Json primitive = glb.primitive();
    primitive["indices"] = glb.addIndices({0, 1, 2});
    for (int k = 0; k < 20'000; ++k) {
      primitive["attributes"]["TEXCOORD_0"] = glb.addAccessor(view, 5126, "VEC2", 3000);
      glb.json["meshes"][0]["primitives"].push_back(primitive);
    }
  });
}

TEST(Hostile, VeryManyViewsOfTheSameDataAreStoredOnce) {
  const Glb glb = manyVertices([](Glb& many) {
    // Each view is used by the face and by something else.
    constexpr std::size_t vertices = 12;
    const Json view = many.json["bufferViews"][0];
    for (int k = 0; k < 500; ++k) {
      const std::size_t number = many.add("bufferViews", view);
      const std::size_t position = many.addAccessor(number, 5126, "VEC3", vertices),
                        other = many.addAccessor(number, 5126, "VEC3", vertices);
      many.accessor(other)["byteOffset"] = 12 * vertices;
      const Json attributes{{"POSITION", position}, {"_A", other}};
      many.add("meshes", {{"primitives", Json::array({{{"attributes", attributes}}})}});
    }
  });
  EXPECT_LE(gltf::parseScene(read(glb).scene).value().buffers[0].size(), glb.binary.size());
}

TEST(Hostile, LongNamesOfAccessorsAreStoredOnce) {
  Glb glb = smallFace();
  glb.accessor(4)["name"] = std::string(100'000, 'x');
  Json& targets = glb.primitive()["targets"];
  for (int k = 0; k < 1000; ++k) targets.push_back({{"POSITION", 4}});
  EXPECT_LT(memoryOf(glb.bytes(), true), 20'000'000u);
}

TEST(Hostile, ManyEmptyTargetsOfAFewVerticesAreRead) {
  Glb glb = smallFace();
  Json& targets = glb.primitive()["targets"];
  for (int k = 0; k < 300; ++k) targets.push_back(Json::object());
  EXPECT_EQ(read(glb).rig.targets.size(), 302u);
}

/// Visits the path of every value of the JSON, for replacing one value at a time.
void replaceEach(const Json& json, Json path, const std::function<void(const Json&)>& visit) {
  visit(path);
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    Json deeper = path;
    deeper.push_back(key);
    replaceEach(value, deeper, visit);
  }
}

Json& at(Json& json, const Json& path) {
  Json* found = &json;
  for (const Json& key : path)
    found = found->is_array() ? &(*found)[std::stoul(key.get<std::string>())]
                              : &(*found)[key.get<std::string>()];
  return *found;
}

TEST(Hostile, AnyValueMayBeOfAnyKind) {
  const Glb good = smallFace();
  Json whole = good.json;
  whole["buffers"] = {{{"byteLength", good.binary.size()}}};
  const std::vector<Json> others{Json(),
                                 true,
                                 -1,
                                 0,
                                 7,
                                 1.5,
                                 1e300,
                                 kMany,
                                 18446744073709551615u,
                                 "x",
                                 Json::array(),
                                 Json::object(),
                                 Json::array({Json::array()})};
  std::size_t accepted = 0, refusals = 0;
  replaceEach(whole, Json::array(), [&](const Json& path) {
    for (const Json& other : others) {
      Json changed = whole;
      at(changed, path) = other;
      const auto source = parseGltf(gltf::formatContainer(changed, good.binary), "face.glb", {});
      ++(source ? accepted : refusals);
      EXPECT_TRUE(source || failsWith(source, {"face.glb: "})) << path;
      EXPECT_TRUE(!source || gltf::parseScene(source->scene)) << path << other;
    }
  });
  EXPECT_GT(accepted, 100u);
  EXPECT_GT(refusals, 500u);
}

TEST(Hostile, AnyMemberMayBeMissing) {
  const Glb good = smallFace();
  Json whole = good.json;
  whole["buffers"] = {{{"byteLength", good.binary.size()}}};
  replaceEach(whole, Json::array(), [&](const Json& path) {
    if (path.empty()) return;
    Json changed = whole, parent = path;
    parent.erase(parent.size() - 1);
    Json& holder = at(changed, parent);
    if (!holder.is_object()) return;
    holder.erase(path.back().get<std::string>());
    const auto source = parseGltf(gltf::formatContainer(changed, good.binary), "face.glb", {});
    EXPECT_TRUE(source || failsWith(source, {"face.glb: "})) << path;
  });
}

}  // namespace
}  // namespace sweepface
