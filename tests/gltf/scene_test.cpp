#include "gltf/scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "gltf/accessor.hpp"
#include "gltf/deflate.hpp"
#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

gltf::Document parsed(const std::string& bytes) {
  auto document = gltf::parseDocument(bytes, {});
  if (!document) ADD_FAILURE() << document.error().message;
  return document ? std::move(*document) : gltf::Document{};
}
gltf::Document parsedScene(const std::string& scene) { return gltf::parseScene(scene).value(); }
gltf::Document sceneFrom(const Glb& glb) { return parsedScene(read(glb).scene); }

std::vector<double> valuesOf(const gltf::Document& document, const Json& accessor) {
  const auto found = gltf::accessorAt(document, accessor.get<std::size_t>());
  if (!found) ADD_FAILURE() << found.error().message;
  return found ? gltf::decode(document, *found).value() : std::vector<double>{};
}
bool hasData(const gltf::Document& document, const Json& accessor) {
  return gltf::accessorAt(document, accessor.get<std::size_t>())->hasData();
}
const Json& primitiveOf(const gltf::Document& document, std::size_t mesh = 0) {
  return document.json["meshes"][mesh]["primitives"][0];
}

/// Adds a mesh without targets, which is not part of a face that has some.
std::size_t addHair(Glb& glb) {
  std::vector<Vec3> positions;
  for (int k = 0; k < 9; ++k) positions.push_back({1.0 * k, 2.0 * k, 3.0 * (k % 3)});
  return glb.add(
      "meshes",
      {{"name", "hair"},
       {"primitives",
        {{{"attributes",
           {{"POSITION", glb.addVectors(positions)}, {"NORMAL", glb.addVectors(positions)}}}}}}});
}

// ---- What the rig stands for goes ----

TEST(Scene, LosesTheDataOfTheFace) {
  const gltf::Document scene = sceneFrom(smallFace());
  const Json& primitive = primitiveOf(scene);
  EXPECT_FALSE(hasData(scene, primitive["attributes"]["POSITION"]));
  EXPECT_FALSE(hasData(scene, primitive["attributes"]["NORMAL"]));
  EXPECT_FALSE(hasData(scene, primitive["targets"][0]["POSITION"]));
  EXPECT_FALSE(hasData(scene, primitive["targets"][1]["POSITION"]));
  EXPECT_FALSE(hasData(scene, primitive["attributes"]["TEXCOORD_0"]));
  EXPECT_FALSE(hasData(scene, primitive["indices"]));
  for (const char* key : {"buffers", "bufferViews"}) EXPECT_FALSE(scene.json.contains(key)) << key;
}

TEST(Scene, EmptiedAccessorsStayWithTheirCounts) {
  Glb glb = smallFace();
  Json& normal = glb.attribute("NORMAL");
  normal["name"] = "normals";
  normal["min"] = {0, 0, 1};
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(scene.json["accessors"][0], Json::object({{"componentType", 5126},
                                                      {"type", "VEC3"},
                                                      {"count", 9},
                                                      {"min", {0, 0, 0}},
                                                      {"max", {0, 0, 0}}}));
  EXPECT_EQ(
      scene.json["accessors"][1],
      Json::object({{"componentType", 5126}, {"type", "VEC3"}, {"count", 9}, {"name", "normals"}}));
  EXPECT_EQ(scene.json["accessors"][primitiveOf(scene)["indices"].get<std::size_t>()],
            Json::object(
                {{"componentType", 5123}, {"type", "SCALAR"}, {"count", sheetIndices().size()}}));
}

/// A strip becomes a list of its triangles.
TEST(Scene, IndicesWithoutDataAreOfTrianglesOneByOne) {
  Glb glb = smallFace();
  glb.primitive()["mode"] = 5;
  glb.primitive()["indices"] = glb.addIndices({0, 3, 1, 4, 4, 7});
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(primitiveOf(scene)["mode"], 4);
  EXPECT_EQ(scene.json["accessors"][primitiveOf(scene)["indices"].get<std::size_t>()]["count"], 6);
}

TEST(Scene, HasTheSamePartsAsItsSource) {
  Glb glb = smallFace();
  addHair(glb);
  glb.json["nodes"][0]["scale"] = {1, 2, 3};
  const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
  const auto before = gltf::findParts(source), after = gltf::findParts(scene);
  ASSERT_TRUE(after) << after.error().message;
  ASSERT_EQ(after->runs.size(), before->runs.size());
  EXPECT_EQ(after->vertexCount, before->vertexCount);
  EXPECT_EQ(after->targets, before->targets);
  EXPECT_EQ(after->meshes[0].world, before->meshes[0].world);
  EXPECT_EQ(after->runs[0].position, before->runs[0].position);
  EXPECT_EQ(after->runs[0].targets, before->runs[0].targets);
}

TEST(Scene, TangentsGoAndAreMissedByNormalMapsAlone) {
  Glb glb = smallFace();
  glb.primitive()["attributes"]["TANGENT"] =
      glb.addAccessor(glb.addView(std::string(9 * 16, '\1')), 5126, "VEC4", 9);
  glb.primitive()["targets"][0]["TANGENT"] = glb.addVectors(openDeltas());
  RigSource source = read(glb);
  EXPECT_TRUE(source.warnings.empty());
  const gltf::Document scene = parsedScene(source.scene);
  EXPECT_FALSE(primitiveOf(scene)["attributes"].contains("TANGENT"));
  EXPECT_FALSE(primitiveOf(scene)["targets"][0].contains("TANGENT"));
  EXPECT_TRUE(scene.buffers.empty());
  EXPECT_EQ(scene.json["accessors"].size(), glb.json["accessors"].size());

  glb.json["materials"][0]["normalTexture"] = {{"index", 0}};
  source = read(glb);
  ASSERT_EQ(source.warnings.size(), 1u);
  EXPECT_NE(source.warnings[0].find("tangents"), std::string::npos);
}

// ---- Everything else stays ----

void expectKept(const Glb& glb, const char* what) {
  const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
  const auto valuesIn = [&](const gltf::Document& document) {
    const Json& primitive = primitiveOf(document);
    return valuesOf(document, what == std::string_view("indices") ? primitive[what]
                                                                  : primitive["attributes"][what]);
  };
  EXPECT_EQ(valuesIn(scene), valuesIn(source)) << what;
}

TEST(Scene, KeepsOtherAttributes) {
  Glb glb = smallFace();
  std::vector<Vec2> texcoords;
  for (int v = 0; v < 9; ++v) texcoords.push_back({0.1 * v, 0.5});
  glb.primitive()["attributes"]["TEXCOORD_1"] = glb.addTexcoords(texcoords);
  expectKept(glb, "TEXCOORD_1");
}

TEST(Scene, KeepsIndicesThatExtensionsMayCountOn) {
  Glb glb = smallFace();
  glb.primitive()["extensions"]["KHR_materials_variants"] = Json::object();
  EXPECT_FALSE(hasData(sceneFrom(glb), primitiveOf(sceneFrom(glb))["indices"]));
  glb.primitive()["extensions"]["TEST_edges"] = Json::object();
  expectKept(glb, "indices");
  expectKept(glb, "TEXCOORD_0");
  glb = smallFace();
  glb.json["meshes"][0]["extensions"]["EXT_mesh_manifold"] = Json::object();
  expectKept(glb, "indices");
}

/// The face stores them transformed, and the originals cannot always be recovered.
TEST(Scene, KeepsTextureCoordinatesThatTheFaceHasOtherwise) {
  Glb glb = smallFace();
  glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {0, 1}}}}}}};
  expectKept(glb, "TEXCOORD_0");
  glb = smallFace();
  std::vector<std::uint16_t> shares(18, 4711);
  glb.primitive()["attributes"]["TEXCOORD_0"] =
      glb.addAccessor(glb.addView(bytesOf(shares)), 5123, "VEC2", 9);
  glb.attribute("TEXCOORD_0")["normalized"] = true;
  expectKept(glb, "TEXCOORD_0");
}

TEST(Scene, KeepsIndicesAndTextureCoordinatesThatOthersUseToo) {
  Glb glb = smallFace();
  const std::size_t hair = addHair(glb);
  Json& strands = glb.json["meshes"][hair]["primitives"][0];
  strands["indices"] = glb.primitive()["indices"];
  strands["attributes"]["TEXCOORD_0"] = glb.primitive()["attributes"]["TEXCOORD_0"];
  const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
  EXPECT_EQ(valuesOf(scene, primitiveOf(scene, hair)["indices"]),
            valuesOf(source, primitiveOf(source, hair)["indices"]));
  EXPECT_EQ(valuesOf(scene, primitiveOf(scene, hair)["attributes"]["TEXCOORD_0"]),
            valuesOf(source, primitiveOf(source, hair)["attributes"]["TEXCOORD_0"]));
  EXPECT_FALSE(hasData(scene, primitiveOf(scene)["indices"]));
  EXPECT_FALSE(hasData(scene, primitiveOf(scene)["attributes"]["TEXCOORD_0"]));
}

TEST(Scene, KeepsWhatIsUnknown) {
  Glb glb = smallFace();
  glb.json["extensionsUsed"] = {"EXT_hair"};
  glb.json["extensions"] = {{"EXT_hair", {{"z", 1.5}, {"a", {1, 2, Json()}}, {"name", "\u00e9"}}}};
  glb.json["extras"] = {{"b", true}, {"a", -0.1}, {"n", 18446744073709551615u}};
  glb.json["nodes"][0]["extensions"] = {{"EXT_hair", {{"strands", 3}}}};
  glb.json["cameras"] = {{{"type", "perspective"}}};
  glb.json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
  glb.json["skins"] = {{{"joints", {0}}}};
  glb.json["scenes"] = {{{"nodes", {0}}}};
  glb.json["scene"] = 0;
  const gltf::Document scene = sceneFrom(glb);
  for (const char* key : {"extensionsUsed", "extensions", "extras", "nodes", "cameras",
                          "animations", "skins", "scene", "materials", "asset"})
    EXPECT_EQ(scene.json[key].dump(), glb.json[key].dump()) << key;
}

TEST(Scene, LosesTheDataOfWhatNothingUses) {
  for (const bool unknown : {false, true}) {
    Glb glb = smallFace();
    addHair(glb);
    const std::size_t left = glb.addVectors({{1, 2, 3}, {4, 5, 6}});
    if (unknown) glb.json["extensionsUsed"] = {"EXT_hair"};
    const gltf::Document scene = sceneFrom(glb);
    EXPECT_EQ(hasData(scene, left), unknown);
    EXPECT_EQ(scene.json["accessors"][left]["count"], 2);
    EXPECT_TRUE(hasData(scene, primitiveOf(scene, 1)["attributes"]["POSITION"]));
  }
}

/// Nobody has looked at accessors that nothing uses.
TEST(Scene, KeepsDamagedAccessorsThatNothingUses) {
  Json sound = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 9}, {"bufferView", 0}};
  for (const auto& [key, value] : std::vector<std::pair<const char*, Json>>{
           {"sparse", "none"}, {"sparse", {{"count", 1}}}, {"count", "nine"}}) {
    Glb glb = smallFace();
    Json damaged = sound;
    damaged[key] = value;
    glb.add("accessors", damaged);
    EXPECT_EQ(sceneFrom(glb).json["accessors"].back(), damaged) << key;
  }
}

TEST(Scene, KeepsOtherMeshes) {
  Glb glb = smallFace();
  const std::size_t hair = addHair(glb);
  const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
  for (const char* name : {"POSITION", "NORMAL"})
    EXPECT_EQ(valuesOf(scene, primitiveOf(scene, hair)["attributes"][name]),
              valuesOf(source, primitiveOf(source, hair)["attributes"][name]));
}

TEST(Scene, KeepsAccessorsThatOthersUseToo) {
  Glb glb = smallFace();
  Json lines = {{"mode", 1}, {"attributes", {{"POSITION", 0}}}};
  glb.json["meshes"][0]["primitives"].push_back(lines);
  const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
  const Json& kept = scene.json["meshes"][0]["primitives"][1]["attributes"]["POSITION"];
  EXPECT_EQ(kept, 0);
  EXPECT_EQ(valuesOf(scene, kept), valuesOf(source, 0));
  const Json& emptied = primitiveOf(scene)["attributes"]["POSITION"];
  EXPECT_EQ(emptied, glb.json["accessors"].size());
  EXPECT_FALSE(hasData(scene, emptied));
}

TEST(Scene, NoTwoShapesOrRunsShareAnEmptiedAccessor) {
  Glb glb = smallFace();
  const Json open = glb.primitive()["targets"][0]["POSITION"];
  glb.primitive()["targets"][1]["POSITION"] = open;
  Json again = glb.primitive();
  again["targets"][0] = Json::object();
  glb.json["meshes"][0]["primitives"].push_back(again);
  glb.add("nodes", {{"mesh", glb.add("meshes", {{"primitives", Json::array({glb.primitive()})}})}});
  const gltf::Document scene = sceneFrom(glb);
  const auto parts = gltf::findParts(scene);
  ASSERT_TRUE(parts) << parts.error().message;
  ASSERT_EQ(parts->runs.size(), 3u);
  std::vector<std::size_t> seen;
  for (const gltf::Run& run : parts->runs) {
    seen.push_back(run.position);
    for (const auto& target : run.targets)
      if (target) seen.push_back(*target);
  }
  std::ranges::sort(seen);
  EXPECT_EQ(std::ranges::adjacent_find(seen), seen.end());
  EXPECT_EQ(seen.size(), 8u);
}

// ---- Bytes ----

constexpr std::size_t texcoordBytes = 9 * 8;

/// The small face with a second set of texture coordinates, which a scene keeps.
Glb keptFace() {
  Glb glb = smallFace();
  std::vector<Vec2> texcoords;
  for (const Vec3& p : sheetPositions()) texcoords.push_back({p.x / 2, p.y / 2});
  glb.primitive()["attributes"]["TEXCOORD_1"] = glb.addTexcoords(texcoords);
  return glb;
}

/// Position, normal and texture coordinates in one view, vertex by vertex.
Glb interleavedFace() {
  Glb glb = keptFace();
  std::vector<float> values;
  for (const Vec3& p : sheetPositions())
    for (const double x : {p.x, p.y, p.z, 0.0, 0.0, 1.0, p.x / 2, p.y / 2})
      values.push_back(static_cast<float>(x));
  const std::size_t view = glb.addView(bytesOf(values), 32);
  for (const auto& [name, offset] :
       {std::pair{"POSITION", 0}, {"NORMAL", 12}, {"TEXCOORD_1", 24}}) {
    Json& accessor = glb.attribute(name);
    accessor["bufferView"] = view;
    accessor["byteOffset"] = offset;
  }
  return glb;
}

TEST(Scene, LosesTheDataOfTheFaceFromBetweenOthers) {
  const gltf::Document source = parsed(keptFace().bytes()), scene = sceneFrom(interleavedFace());
  EXPECT_EQ(valuesOf(scene, primitiveOf(scene)["attributes"]["TEXCOORD_1"]),
            valuesOf(source, primitiveOf(source)["attributes"]["TEXCOORD_1"]));
  EXPECT_EQ(scene.buffers[0].size(), texcoordBytes);
  EXPECT_EQ(scene.views.size(), 1u);
}

TEST(Scene, LosesTheDataOfTheFaceFromBesideOthers) {
  // The face and the hair, one after the other in one view.
  Glb glb = smallFace();
  const std::size_t hair = addHair(glb);
  std::string bytes = floatsOf(sheetPositions());
  const std::size_t offset = bytes.size();
  std::vector<Vec3> strands;
  for (int k = 0; k < 9; ++k) strands.push_back({0.5 * k, 1, 2});
  bytes += floatsOf(strands) + floatsOf(openDeltas());
  for (const std::size_t stride : {0, 12}) {
    const std::size_t view = glb.addView(bytes, stride);
    glb.attribute("POSITION")["bufferView"] = view;
    glb.attribute("POSITION", hair)["bufferView"] = view;
    glb.attribute("POSITION", hair)["byteOffset"] = offset;
    const gltf::Document source = parsed(glb.bytes()), scene = sceneFrom(glb);
    EXPECT_EQ(valuesOf(scene, primitiveOf(scene, hair)["attributes"]["POSITION"]),
              valuesOf(source, primitiveOf(source, hair)["attributes"]["POSITION"]));
    EXPECT_EQ(scene.buffers[0].size(), 2 * 9 * 12u);
  }
}

TEST(Scene, BytesThatViewsShareAreStoredOnce) {
  Glb glb = keptFace();
  const Json texcoords = glb.attribute("TEXCOORD_1");
  const Json view = glb.json["bufferViews"][texcoords["bufferView"].get<std::size_t>()];
  for (int k = 2; k < 50; ++k) {
    Json copy = texcoords;
    copy["bufferView"] = glb.add("bufferViews", view);
    glb.primitive()["attributes"][fmt::format("TEXCOORD_{}", k)] = glb.add("accessors", copy);
  }
  EXPECT_EQ(sceneFrom(glb).buffers[0].size(), texcoordBytes);
}

TEST(Scene, UnknownExtensionsKeepTheNumbersOfTheirViews) {
  Glb glb = smallFace();
  const std::size_t secret = glb.addView("secret bytes");
  glb.json["extensionsUsed"] = {"EXT_hair"};
  glb.json["extensions"]["EXT_hair"] = {{"strandsView", secret}, {"bufferView", secret}};
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(scene.views.size(), glb.json["bufferViews"].size());
  EXPECT_EQ(scene.bytesOf(secret), "secret bytes");
  EXPECT_EQ(scene.json["extensions"].dump(), glb.json["extensions"].dump());
  EXPECT_EQ(scene.bytesOf(0).size(), 1u);
}

TEST(Scene, UnknownExtensionsKeepViewsThatTheyNameInWordsOfTheirOwn) {
  Glb glb = smallFace();
  const std::size_t secret = glb.addView("secret bytes");
  glb.json["extensionsUsed"] = {"EXT_structural_metadata"};
  glb.json["extensions"]["EXT_structural_metadata"] = {{"values", secret}};
  const gltf::Document scene = sceneFrom(glb);
  ASSERT_EQ(scene.views.size(), glb.json["bufferViews"].size());
  EXPECT_EQ(scene.bytesOf(secret), "secret bytes");
  EXPECT_EQ(scene.bytesOf(0).size(), 1u) << "the face's own are gone";
}

TEST(Scene, WhatBuffersSayOfThemselvesKeepsNoView) {
  Glb glb = smallFace();
  const std::size_t secret = glb.addView("secret bytes");
  glb.json["buffers"] = {
      {{"byteLength", glb.binary.size()}, {"extras", 1}, {"of", {{"bufferView", secret}}}}};
  EXPECT_TRUE(sceneFrom(glb).views.empty());
}

TEST(Scene, KnownExtensionsFollowTheirViews) {
  Glb glb = smallFace();
  const std::size_t secret = glb.addView("secret bytes");
  glb.json["extensionsUsed"] = {"KHR_audio_emitter"};
  glb.json["extensions"]["KHR_audio_emitter"] = {{"audio", {{{"bufferView", secret}}}}};
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(scene.views.size(), 1u);
  const Json& audio = scene.json["extensions"]["KHR_audio_emitter"]["audio"][0];
  EXPECT_EQ(scene.bytesOf(audio["bufferView"].get<std::size_t>()), "secret bytes");
}

TEST(Scene, OfAFaceAloneHasNoBytes) {
  Glb glb;
  glb.add(
      "meshes",
      {{"primitives",
        {{{"attributes", {{"POSITION", glb.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}}}}}});
  const gltf::Document scene = sceneFrom(glb);
  for (const char* key : {"buffers", "bufferViews"}) EXPECT_FALSE(scene.json.contains(key)) << key;
  EXPECT_TRUE(gltf::findParts(scene));
}

TEST(Scene, IsDeflatedUnlessNobodyWouldBelieveIt) {
  Glb glb = smallFace();
  const auto zeros = [&](std::size_t bytes) {
    glb.json["images"] = {{{"bufferView", glb.addView(std::string(bytes, '\0'))}}};
    return read(glb).scene;
  };
  EXPECT_LT(zeros(10'000).size(), 1'000u);
  const std::string large = zeros(2'000'000);
  EXPECT_TRUE(large.starts_with("glTF"));
  for (const std::string& scene : {zeros(10'000), large}) EXPECT_TRUE(gltf::parseScene(scene));
}

/// Whether accessors follow each other or are interleaved, the first bytes of all numbers are
/// stored together: they deflate to less, and come back the same.
TEST(Scene, NumbersAreDeflatedInPlanes) {
  constexpr std::size_t rows = 400, width = 24;
  for (const bool interleaved : {false, true}) {
    Glb glb = smallFace();
    std::vector<float> numbers;
    for (std::size_t k = 0; k < rows * width / 4; ++k)
      numbers.push_back(std::sin(0.0017f * static_cast<float>(k / 6) + static_cast<float>(k % 6)));
    const std::size_t view = glb.addView(bytesOf(numbers), interleaved ? width : 0);
    const std::size_t second = glb.addAccessor(view, 5126, "VEC3", rows);
    glb.json["accessors"][second]["byteOffset"] = interleaved ? 12 : 12 * rows;
    const std::size_t first = glb.addAccessor(view, 5126, "VEC3", rows);
    glb.add("meshes",
            {{"primitives", {{{"attributes", {{"POSITION", first}, {"NORMAL", second}}}}}}});
    const std::string text = read(glb).scene;
    const gltf::Document scene = gltf::parseScene(text).value(), source = parsed(glb.bytes());
    for (const std::size_t accessor : {first, second})
      EXPECT_EQ(valuesOf(scene, accessor), valuesOf(source, accessor)) << interleaved;
    const std::string plain = gltf::formatContainer(scene.json, scene.buffers[0]);
    EXPECT_LT(text.size(), 4 * gltf::deflated(plain).size() / 5) << interleaved;
    EXPECT_EQ(gltf::formatScene(plain), text) << interleaved;
  }
}

/// The bytes that planes add count, too, where a scene inflates to just about the most accepted.
TEST(Scene, CanBeReadHoweverWellItDeflates) {
  std::vector<float> numbers;
  for (int k = 0; k < 1200; ++k) numbers.push_back(std::sin(0.0017f * static_cast<float>(k)));
  const auto format = [&](std::size_t zeros) {
    Glb glb;
    for (std::size_t a = 0, view = glb.addView(bytesOf(numbers)); a < 40; ++a) {
      glb.addAccessor(view, 5126, "SCALAR", 30);
      glb.json["accessors"][a]["byteOffset"] = 120 * a;
    }
    glb.json["images"] = {{{"bufferView", glb.addView(std::string(zeros, '\0'))}}};
    return gltf::formatScene(glb.bytes());
  };
  std::size_t low = 0, high = 4'000'000;  // bracket the smallest that is refused
  while (high - low > 4) {
    const std::size_t middle = (low + high) / 2;
    (format(middle).starts_with("glTF") ? high : low) = middle;
  }
  ASSERT_TRUE(format(low).starts_with('\1'));
  for (std::size_t zeros = low - 400; zeros < high; zeros += 4)
    EXPECT_TRUE(gltf::parseScene(format(zeros))) << zeros;
}

TEST(Scene, InPlanesThatIsCutShortIsRefused) {
  const std::string text = "\1" + gltf::deflated(std::string("\1\0\0\0GLB", 7));
  const auto scene = gltf::parseScene(text);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "it is damaged");
  EXPECT_FALSE(gltf::parseScene("\1"));
}

// ---- Images ----

class Images : public ::testing::Test {
 protected:
  static constexpr std::string_view png = "\x89PNG\r\n\x1A\nimage";

  gltf::Document sceneWith(const Json& image) {
    Glb glb = smallFace();
    glb.json["images"] = Json::array({image, image});
    auto source = parseGltf(glb.bytes(), "face.glb", folder / "home");
    if (!source) ADD_FAILURE() << source.error().message;
    warnings = source->warnings;
    return parsedScene(source->scene);
  }
  void SetUp() override {
    folder.file("home/skin.png", png);
    folder.file("home/notes.txt", "no image");
    folder.file("secret.png", png);
  }
  TemporaryFolder folder;
  std::vector<std::string> warnings;
};

TEST_F(Images, BesideTheFileAreEmbeddedOnce) {
  const gltf::Document scene = sceneWith({{"uri", "skin.png"}, {"name", "skin"}});
  for (const Json& image : scene.list("images")) {
    EXPECT_EQ(image["name"], "skin");
    EXPECT_FALSE(image.contains("uri"));
    EXPECT_EQ(image["mimeType"], "image/png");
    EXPECT_EQ(image["bufferView"], scene.views.size() - 1);
    EXPECT_EQ(scene.bytesOf(image["bufferView"].get<std::size_t>()), png);
  }
  EXPECT_TRUE(warnings.empty());
}

TEST_F(Images, AreEmbeddedOnceHoweverTheyAreSpelt) {
  Glb glb = smallFace();
  glb.json["images"] = {{{"uri", "skin.png"}}, {{"uri", "%73kin.png"}}, {{"uri", "./skin.png"}}};
  const auto source = parseGltf(glb.bytes(), "face.glb", folder / "home");
  ASSERT_TRUE(source) << source.error().message;
  const gltf::Document scene = parsedScene(source->scene);
  for (const Json& image : scene.list("images"))
    EXPECT_EQ(image["bufferView"], scene.views.size() - 1);
}

TEST_F(Images, OfOtherKindsAreWhatTheFileSays) {
  folder.file("home/skin.avif", "an image");
  const gltf::Document scene = sceneWith({{"uri", "skin.avif"}, {"mimeType", "image/avif"}});
  EXPECT_EQ(scene.list("images")[0]["mimeType"], "image/avif");
  EXPECT_EQ(scene.bytesOf(scene.views.size() - 1), "an image");
  EXPECT_TRUE(warnings.empty());
}

TEST_F(Images, InDataUrisAreEmbedded) {
  const gltf::Document scene = sceneWith({{"uri", "data:image/x-hair;base64,aGVsbG8="}});
  EXPECT_EQ(scene.list("images")[0]["mimeType"], "image/x-hair");
  EXPECT_EQ(scene.bytesOf(scene.views.size() - 1), "hello");
}

TEST_F(Images, InTheFileStay) {
  Glb glb = smallFace();
  glb.json["images"] = {{{"bufferView", glb.addView(png)}, {"mimeType", "image/png"}}};
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(scene.bytesOf(scene.list("images")[0]["bufferView"].get<std::size_t>()), png);
}

TEST_F(Images, ThatCannotBeReadStayReferencesWithAWarning) {
  for (const std::string& uri : std::initializer_list<std::string>{
           "../secret.png", "nothing.png", "notes.txt", "https://example.org/skin.png",
           (folder / "secret.png").string()}) {
    const gltf::Document scene = sceneWith({{"uri", uri}});
    EXPECT_EQ(scene.list("images")[0]["uri"], uri);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[0].find("Image 0 stays a reference"), std::string::npos) << warnings[0];
    EXPECT_TRUE(warnings[0].ends_with('.'));
  }
}

// ---- References ----

TEST(Scene, NamesThatLookLikeReferencesAreNone) {
  Glb glb = smallFace();
  const std::size_t last = glb.json["accessors"].size() - 1;
  glb.json["meshes"][0]["primitives"][0]["attributes"]["bufferView"] = last;
  glb.json["meshes"][0]["extras"]["bufferView"] = 1;
  const gltf::Document scene = sceneFrom(glb);
  EXPECT_EQ(primitiveOf(scene)["attributes"]["bufferView"], last);
  EXPECT_EQ(scene.json["meshes"][0]["extras"]["bufferView"], 1);
}

}  // namespace
}  // namespace sweepface
