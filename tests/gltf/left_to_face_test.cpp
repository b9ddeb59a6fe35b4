#include "gltf/left_to_face.hpp"

#include "sweepface/codec.hpp"
#include "sweepface/strip.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

std::vector<Index> asRead(const std::vector<std::uint16_t>& indices) {
  return {indices.begin(), indices.end()};
}

/// The triangles in ascending order, each starting at its smallest vertex.
std::vector<Loop> trianglesOf(const std::vector<Index>& indices) {
  std::vector<Loop> triangles;
  for (std::size_t k = 0; k < indices.size(); k += 3) {
    Loop t(indices.begin() + static_cast<std::ptrdiff_t>(k),
           indices.begin() + static_cast<std::ptrdiff_t>(k + 3));
    std::ranges::rotate(t, std::ranges::min_element(t));
    triangles.push_back(std::move(t));
  }
  std::ranges::sort(triangles);
  return triangles;
}
/// Indices of the sheet of 2 × 2 quads. Bit k of `across` cuts quad k along its second diagonal.
std::vector<std::uint16_t> sheetCut(unsigned across) {
  std::vector<std::uint16_t> indices;
  for (const std::uint16_t a :
       {std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{3}, std::uint16_t{4}}) {
    const auto b = static_cast<std::uint16_t>(a + 1), c = static_cast<std::uint16_t>(a + 4),
               d = static_cast<std::uint16_t>(a + 3);
    if (across & 1)
      indices.insert(indices.end(), {b, c, d, b, d, a});
    else
      indices.insert(indices.end(), {a, b, c, a, c, d});
    across >>= 1;
  }
  return indices;
}

// ---- Triangles ----

TEST(LeftToFace, TrianglesComeBackAsTheyWereWhereQuadsWereCutFromTheirFirstCorner) {
  for (unsigned across = 0; across < 16; ++across) {
    Glb glb = smallFace();
    const auto indices = sheetCut(across);
    glb.primitive()["indices"] = glb.addIndices(indices);
    EXPECT_EQ(write(converted(glb)).indices(), asRead(indices)) << across;
  }
}

TEST(LeftToFace, TrianglesOfAnyOrderAreTheSameOnes) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    auto indices = sheetCut(static_cast<unsigned>(round));
    std::vector<std::array<std::uint16_t, 3>> triangles(8);
    for (std::size_t k = 0; k < indices.size(); ++k) triangles[k / 3][k % 3] = indices[k];
    std::ranges::shuffle(triangles, random);
    for (std::size_t k = 0; k < indices.size(); ++k)
      indices[k] = triangles[k / 3][(k + static_cast<std::size_t>(round)) % 3];
    Glb glb = smallFace();
    glb.primitive()["indices"] = glb.addIndices(indices);
    EXPECT_EQ(trianglesOf(write(converted(glb)).indices()), trianglesOf(asRead(indices)));
  }
}

TEST(LeftToFace, TrianglesOfMirroredMeshesLookTheSameWay) {
  Glb glb = smallFace();
  glb.json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(trianglesOf(write(converted(glb)).indices()), trianglesOf(asRead(sheetIndices())));
}

TEST(LeftToFace, StripsBecomeTriangles) {
  Glb glb = smallFace();
  glb.primitive()["mode"] = 5;
  glb.primitive()["indices"] = glb.addIndices({0, 3, 1, 4, 2, 5});
  const Written written = write(converted(glb));
  EXPECT_EQ(written.primitive()["mode"], 4);
  EXPECT_EQ(trianglesOf(written.indices()),
            (std::vector<Loop>{{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}}));
}

TEST(LeftToFace, IndicesKeepTheirType) {
  Glb glb = smallFace();
  std::vector<std::uint32_t> wide;
  for (const std::uint16_t v : sheetIndices()) wide.push_back(v);
  const std::size_t accessor =
      glb.addAccessor(glb.addView(bytesOf(wide)), 5125, "SCALAR", wide.size());
  glb.primitive()["indices"] = accessor;
  const Written written = write(converted(glb));
  EXPECT_EQ(written.primitive()["indices"], accessor);
  EXPECT_EQ(written.accessor(accessor)["componentType"], 5125);
  EXPECT_EQ(written.indices(), asRead(sheetIndices()));
}

TEST(LeftToFace, PartsThatSharedIndicesHaveTheirOwn) {
  Glb glb = smallFace();
  glb.json["meshes"].push_back(glb.json["meshes"][0]);
  glb.json["nodes"].push_back({{"mesh", 1}, {"translation", {0, 0, 1}}});
  const Written written = write(converted(glb));
  EXPECT_NE(written.primitive(0)["indices"], written.primitive(1)["indices"]);
  for (const std::size_t mesh : {0, 1})
    EXPECT_EQ(written.indices(mesh), asRead(sheetIndices())) << mesh;
}

/// An accessor's triangles are counted for both primitives before it is emptied for one of them.
TEST(LeftToFace, IndicesMayBeThoseOfAListAndOfAFan) {
  Glb glb = smallFace();
  const std::size_t indices = glb.addIndices({0, 1, 4, 3, 0, 4});
  glb.primitive()["indices"] = indices;
  Json fan = glb.primitive();
  fan["mode"] = 6;
  for (Json& target : fan["targets"]) target = Json::object();
  glb.json["meshes"][0]["primitives"].push_back(fan);
  const Written written = write(converted(glb));
  EXPECT_EQ(trianglesOf(written.indices(0, 0)), trianglesOf({0, 1, 4, 3, 0, 4}));
  EXPECT_EQ(trianglesOf(written.indices(0, 1)), trianglesOf({0, 1, 4, 0, 4, 3}));
}

/// A quad of two triangles that share no vertex, but whose vertices coincide.
Glb halvesApart(bool indexed) {
  Glb glb;
  const std::vector<Index> corners{0, 1, 4, 0, 4, 3};
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;
  for (const Index v : corners) {
    positions.push_back(sheetPositions()[v]);
    normals.push_back(normalized({1.0 * static_cast<double>(positions.size()), 1, 5}));
    texcoords.push_back({positions.back().x / 4 + 0.25, positions.back().y / 4 + 0.25});
  }
  Json primitive{{"attributes",
                  {{"POSITION", glb.addVectors(positions)},
                   {"NORMAL", glb.addVectors(normals)},
                   {"TEXCOORD_0", glb.addTexcoords(texcoords)}}}};
  if (indexed) primitive["indices"] = glb.addIndices({0, 1, 2, 3, 4, 5});
  glb.add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
  return glb;
}

/// Of doubled vertices, the polygons name only those of the first half.
TEST(LeftToFace, DoubledVerticesKeepTheirTrianglesAndTextureCoordinates) {
  for (const bool indexed : {true, false}) {
    const Glb glb = halvesApart(indexed);
    ASSERT_EQ(read(glb).rig.neutral.polygons.faceCount(), 1);
    const Written before(glb.bytes()), after = write(converted(glb));
    EXPECT_EQ(after.numbers(after.attribute("TEXCOORD_0")),
              before.numbers(before.attribute("TEXCOORD_0")));
    if (!indexed) continue;
    EXPECT_EQ(after.indices(), before.indices());
  }
}

/// A JSON object moves all its members when it gets another one.
TEST(LeftToFace, ComesBackHoweverManyMembersTheSceneHas) {
  for (int members = 0; members < 40; ++members) {
    Glb glb = smallFace();
    for (int k = 0; k < members; ++k) glb.json["member" + std::to_string(k)] = Json::object();
    const Written before(glb.bytes()), after = write(converted(glb));
    EXPECT_EQ(after.indices(), before.indices());
    EXPECT_EQ(after.numbers(after.attribute("TEXCOORD_0")),
              before.numbers(before.attribute("TEXCOORD_0")));
  }
}

// ---- Texture coordinates ----

TEST(LeftToFace, TextureCoordinatesComeBackAsTheyWere) {
  const Glb glb = smallFace();
  const Written before(glb.bytes()), after = write(converted(glb));
  EXPECT_EQ(after.numbers(after.attribute("TEXCOORD_0")),
            before.numbers(before.attribute("TEXCOORD_0")));
}

TEST(LeftToFace, TextureCoordinatesOfPackedFacesAreWithinHalfAStep) {
  Glb glb = smallFace();
  std::vector<Vec2> texcoords;
  for (const Vec3& p : sheetPositions()) texcoords.push_back({p.x / 3, p.y / 7});
  glb.primitive()["attributes"]["TEXCOORD_0"] = glb.addTexcoords(texcoords);
  RigSource source = read(glb);
  ConvertOptions options;
  options.tolerance = 0.05;
  options.pack = true;
  auto conversion = convert(source.rig, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  conversion->rig.scene = source.scene;
  const auto rig = decode(encode(conversion->rig), "face.sweep");
  ASSERT_TRUE(rig) << rig.error().message;
  const Written written = write(*rig);
  const auto found = written.numbers(written.attribute("TEXCOORD_0"));
  const double half = 0x1p-15;
  for (std::size_t v = 0; v < texcoords.size(); ++v) {
    EXPECT_NEAR(found[2 * v], texcoords[v].x, half + 1e-7);
    EXPECT_NEAR(found[2 * v + 1], texcoords[v].y, half + 1e-7);
  }
}

TEST(LeftToFace, TextureCoordinatesAreZerosOnceTheFaceHasNone) {
  Rig rig = converted(smallFace());
  ASSERT_TRUE(strip(rig, {.uv = true}));
  for (const Index lod : {0, 2}) {
    const Written written = write(rig, {.lod = lod});
    for (const double t : written.numbers(written.attribute("TEXCOORD_0"))) EXPECT_EQ(t, 0);
  }
}

/// Two primitives of the same vertices, each of which uses the texture coordinates of some.
TEST(LeftToFace, PartsThatShareTextureCoordinatesGiveTheirsTogether) {
  Glb glb = smallFace();
  const auto indices = sheetIndices();
  const auto middle = indices.begin() + 12;
  Json other = glb.primitive();
  glb.primitive()["indices"] = glb.addIndices({indices.begin(), middle});
  other["indices"] = glb.addIndices({middle, indices.end()});
  glb.json["meshes"][0]["primitives"].push_back(other);
  const Written before(glb.bytes()), after = write(converted(glb));
  EXPECT_EQ(after.attribute("TEXCOORD_0", 0, 0), after.attribute("TEXCOORD_0", 0, 1));
  EXPECT_EQ(after.numbers(after.attribute("TEXCOORD_0")),
            before.numbers(before.attribute("TEXCOORD_0")));
}

/// A face has only as many texture coordinates as one accessor of its vertices holds.
TEST(LeftToFace, OtherAccessorsOfTheSameVerticesAreKept) {
  Glb glb = smallFace();
  Json other = glb.primitive();
  std::vector<Vec2> texcoords;
  for (const Vec3& p : sheetPositions()) texcoords.push_back({p.y / 3, p.x / 5});
  other["attributes"]["TEXCOORD_0"] = glb.addTexcoords(texcoords);
  glb.json["meshes"][0]["primitives"].push_back(other);
  const Written before(glb.bytes()), after = write(converted(glb));
  for (const std::size_t part : {0, 1})
    EXPECT_EQ(after.numbers(after.attribute("TEXCOORD_0", 0, part)),
              before.numbers(before.attribute("TEXCOORD_0", 0, part)));
}

TEST(LeftToFace, FinerMeshesHaveTheirTextureCoordinatesBetween) {
  const Written written = write(converted(smallFace()), {.lod = 2});
  const auto texcoords = written.numbers(written.attribute("TEXCOORD_0"));
  const auto positions = written.vectors(written.attribute("POSITION"));
  ASSERT_EQ(positions.size(), 25u);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    EXPECT_NEAR(texcoords[2 * v], positions[v].x / 2, 0.03);
    EXPECT_NEAR(texcoords[2 * v + 1], positions[v].y / 2, 0.03);
  }
}

// ---- Files of others ----

TEST(LeftToFace, RefusesIndicesThatCannotBeHeld) {
  Rig rig = converted(smallFace());
  const Written scene = sceneOf(rig);
  Json json = scene.json;
  const auto indices = scene.primitive()["indices"].get<std::size_t>();
  json["accessors"][indices]["componentType"] = 5126;
  rig.scene = gltf::formatContainer(json, scene.binary);
  EXPECT_TRUE(failsWith(formatGlb(rig, {}), {"do not fit", "cannot hold indices"}));
}

/// Accessors without data may claim any number of vertices: these claim 2^64 more than there are.
TEST(LeftToFace, RefusesMoreVerticesThanCanBeCounted) {
  Rig rig = converted(smallFace());
  const Written scene = sceneOf(rig);
  Json json = scene.json;
  Json& primitives = json["meshes"][0]["primitives"];
  Json other = primitives[0];
  other.erase("targets");
  json["meshes"][0].erase("weights");
  other["attributes"] = {{"POSITION", json["accessors"].size()}};
  json["accessors"].push_back(
      {{"componentType", 5126}, {"type", "VEC3"}, {"count", std::uint64_t{1} << 52}});
  primitives[0].erase("targets");
  for (int k = 0; k < 1 << 12; ++k) {
    primitives.push_back(other);
    json["accessors"].push_back(json["accessors"].back());
    other["attributes"]["POSITION"] = json["accessors"].size() - 1;
  }
  rig.scene = gltf::formatContainer(json, scene.binary);
  EXPECT_TRUE(failsWith(formatGlb(rig, {}), {"do not fit", "more vertices than an index"}));
}

/// A few bytes can name the same vertices again and again.
TEST(LeftToFace, RefusesFarMoreIndicesThanAFaceCanMean) {
  Rig rig = converted(smallFace());
  const Written scene = sceneOf(rig);
  Json json = scene.json;
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 60'000}}};
  json["buffers"] = {{{"byteLength", 60'000}}};
  Json& primitives = json["meshes"][0]["primitives"];
  Json other = primitives[0];
  other["indices"] = json["accessors"].size();
  json["accessors"].push_back(
      {{"bufferView", 0}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 60'000}});
  for (int k = 0; k < 200; ++k) primitives.push_back(other);
  rig.scene = gltf::formatContainer(json, std::string(60'000, '\0'));
  EXPECT_TRUE(failsWith(formatGlb(rig, {}), {"do not fit", "far more triangles"}));
}

}  // namespace
}  // namespace sweepface
