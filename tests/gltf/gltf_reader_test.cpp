#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <set>

#include "gltf/glb.hpp"
#include "gltf/mesh_rig.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The faces of a mesh, each starting at its smallest vertex.
std::vector<std::vector<Index>> facesOf(const Polygons& polygons) {
  std::vector<std::vector<Index>> faces;
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    std::vector<Index> face(polygons.corners.begin() + polygons.faceStart[f],
                            polygons.corners.begin() + polygons.faceStart[f + 1]);
    std::ranges::rotate(face, std::ranges::min_element(face));
    faces.push_back(face);
  }
  return faces;
}
using Faces = std::vector<std::vector<Index>>;

/// The faces of a file before triangles are joined.
Faces trianglesOf(const Glb& glb) {
  const gltf::Document document = gltf::parseDocument(glb.bytes(), {}).value();
  const gltf::Parts parts = gltf::findParts(document).value();
  return facesOf(gltf::readMeshRig(document, parts).value().rig.neutral.polygons);
}

/// Vertices whose faces do not matter.
Glb points(const std::vector<Vec3>& positions, Json primitive = Json::object()) {
  Glb glb;
  primitive["attributes"]["POSITION"] = glb.addVectors(positions);
  glb.add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
  return glb;
}
std::vector<Vec3> zigzag(int count) {
  std::vector<Vec3> positions;
  for (int k = 0; k < count; ++k) positions.push_back({0.5 * k, 1.0 * (k % 2), 0.1 * k * k});
  return positions;
}

// ---- Shapes ----

TEST(GltfReader, ReadsTheNeutralAndItsTargets) {
  const RigSource source = read(smallFace());
  EXPECT_EQ(source.rig.neutral.positions, sheetPositions());
  ASSERT_EQ(source.rig.targets.size(), 2u);
  EXPECT_EQ(source.rig.targets[0].name, "open");
  std::vector<Vec3> open = sheetPositions(), wink = sheetPositions();
  for (std::size_t v = 0; v < 9; ++v) open[v] += openDeltas()[v];
  wink[2].z += 1, wink[5].y += 1;
  EXPECT_EQ(source.rig.targets[0].positions, open);
  EXPECT_EQ(source.rig.targets[1].positions, wink);
  EXPECT_TRUE(source.warnings.empty());
  EXPECT_TRUE(source.faceWarnings.empty());
}

/// As the standard allows: values that are not given are zero.
TEST(GltfReader, PositionsMayBeSparseAlone) {
  const Glb dense = smallFace();
  Glb glb = smallFace();
  std::vector<std::uint16_t> all(9);
  std::iota(all.begin(), all.end(), 0);
  const std::size_t sparse = glb.addSparse(9, all, sheetPositions());
  glb.primitive()["attributes"]["POSITION"] = sparse;
  EXPECT_EQ(read(glb).rig.neutral.positions, read(dense).rig.neutral.positions);
  glb.accessor(sparse).erase("sparse");
  EXPECT_TRUE(
      failsWith(parseGltf(glb.bytes(), "face.glb", {}), {"POSITION of a mesh has no data"}));
}

TEST(GltfReader, WeightsOfTheMeshAreAPoseAndNoShape) {
  Glb glb = smallFace();
  glb.json["meshes"][0]["weights"] = {1, 0.5};
  EXPECT_EQ(read(glb).rig.neutral.positions, sheetPositions());
}

TEST(GltfReader, ATargetMayLackPositions) {
  Glb glb = smallFace();
  glb.primitive()["targets"][0] = Json::object();
  glb.primitive()["targets"][1] = {{"NORMAL", 1}};
  const RigSource source = read(glb);
  ASSERT_EQ(source.rig.targets.size(), 2u);
  EXPECT_EQ(source.rig.targets[0].positions, sheetPositions());
  EXPECT_EQ(source.rig.targets[1].positions, sheetPositions());
}

TEST(GltfReader, ATargetAccessorWithoutDataMovesNothing) {
  Glb glb = smallFace();
  glb.primitive()["targets"][0]["POSITION"] =
      glb.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 9}});
  EXPECT_EQ(read(glb).rig.targets[0].positions, sheetPositions());
}

TEST(GltfReader, ReadsQuantisedPositionsAndDeltas) {
  Glb glb;
  std::vector<std::int16_t> base, plain;
  std::vector<std::int8_t> normalized;
  for (int v = 0; v < 4; ++v)
    for (int axis = 0; axis < 4; ++axis) {
      base.push_back(static_cast<std::int16_t>(axis < 3 ? 100 * v * (v - axis) : 99));
      plain.push_back(static_cast<std::int16_t>(axis < 3 ? v + axis : 99));
      normalized.push_back(static_cast<std::int8_t>(axis < 3 ? 127 - 127 * (v % 2) : 99));
    }
  const std::size_t b = glb.addAccessor(glb.addView(bytesOf(base), 8), 5122, "VEC3", 4);
  const std::size_t p = glb.addAccessor(glb.addView(bytesOf(plain), 8), 5122, "VEC3", 4);
  const std::size_t n = glb.addAccessor(glb.addView(bytesOf(normalized), 4), 5120, "VEC3", 4);
  glb.accessor(n)["normalized"] = true;
  Json targets = Json::array({{{"POSITION", p}}, {{"POSITION", n}}});
  targets = {Json::object({{"POSITION", p}}), Json::object({{"POSITION", n}})};
  Json primitive = {{"attributes", {{"POSITION", b}}}, {"mode", 5}, {"targets", targets}};
  glb.add("meshes", {{"primitives", Json::array({primitive})}});
  glb.add("nodes", {{"mesh", 0}, {"scale", {0.01, 0.01, 0.01}}, {"translation", {1, 2, 3}}});
  glb.json["extensionsUsed"] = glb.json["extensionsRequired"] = {"KHR_mesh_quantization"};

  const RigSource source = read(glb);
  std::vector<Vec3> neutral, first, second;
  for (int v = 0; v < 4; ++v) {
    neutral.push_back(Vec3{1.0 * v * v, 1.0 * v * (v - 1), 1.0 * v * (v - 2)} + Vec3{1, 2, 3});
    first.push_back(neutral.back() + 0.01 * Vec3{v + 0.0, v + 1.0, v + 2.0});
    second.push_back(neutral.back() + (0.01 - 0.01 * (v % 2)) * Vec3{1, 1, 1});
  }
  expectNear(source.rig.neutral.positions, neutral);
  expectNear(source.rig.targets[0].positions, first);
  expectNear(source.rig.targets[1].positions, second);
}

TEST(GltfReader, PositionsAreNoLongIntegers) {
  Glb glb = smallFace();
  glb.attribute("POSITION")["componentType"] = 5125;
  EXPECT_TRUE(failsWith(parseGltf(glb.bytes(), "face.glb", {}),
                        {"face.glb: accessor", "positions cannot be integers of 32 bits"}));
}

TEST(GltfReader, NormalisedPositionsGoFromMinusOneToOne) {
  Glb glb = points(zigzag(3));
  const std::vector<std::int16_t> values{32767, -32767, 0, 0, 16384, 0, 0, 0, 0, 0, -32768, 0};
  const std::size_t view = glb.addView(bytesOf(values), 8);
  glb.primitive()["attributes"]["POSITION"] = glb.addAccessor(view, 5122, "VEC3", 3);
  glb.accessor(1)["normalized"] = true;
  expectNear(read(glb).rig.neutral.positions, {{1, -1, 0}, {16384.0 / 32767, 0, 0}, {0, 0, -1}});
}

// ---- Triangles ----

TEST(GltfReader, ReadsListsStripsAndFans) {
  const auto facesWith = [](int mode, int count) {
    return trianglesOf(points(zigzag(count), {{"mode", mode}}));
  };
  EXPECT_EQ(facesWith(4, 6), (Faces{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(facesWith(4, 8), (Faces{{0, 1, 2}, {3, 4, 5}}));  // left-over vertices make no triangle
  EXPECT_EQ(facesWith(5, 5), (Faces{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(facesWith(6, 5), (Faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(GltfReader, TrianglesThatNameAVertexTwiceAreNone) {
  Glb glb = points(zigzag(6), {{"mode", 5}});
  glb.primitive()["indices"] = glb.addIndices({0, 1, 2, 2, 3, 3, 4, 5});
  EXPECT_EQ(facesOf(read(glb).rig.neutral.polygons), (Faces{{0, 1, 2}, {3, 5, 4}}));
  glb.primitive()["mode"] = 4;
  glb.primitive()["indices"] = glb.addIndices({0, 1, 1, 2, 3, 2});
  EXPECT_TRUE(refused(glb, {"it has no triangle of three different vertices"}));
}

TEST(GltfReader, ReadsIndicesOfEveryWidth) {
  const auto facesWith = [](auto width, int component) {
    Glb glb = points(zigzag(4));
    const std::vector<decltype(width)> indices{0, 1, 2, 1, 3, 2};
    const std::size_t view = glb.addView(bytesOf(indices));
    glb.primitive()["indices"] = glb.addAccessor(view, component, "SCALAR", 6);
    return trianglesOf(glb);
  };
  const Faces expected{{0, 1, 2}, {1, 3, 2}};
  EXPECT_EQ(facesWith(std::uint8_t{}, 5121), expected);
  EXPECT_EQ(facesWith(std::uint16_t{}, 5123), expected);
  EXPECT_EQ(facesWith(std::uint32_t{}, 5125), expected);
}

TEST(GltfReader, IndicesMustBeWholeNumbersOfVertices) {
  Glb glb = points(zigzag(4));
  glb.primitive()["indices"] = glb.addIndices({0, 1, 4});
  EXPECT_TRUE(refused(glb, {"mesh 0, primitive 0: it refers to vertex 4, but has 4"}));
  glb.primitive()["indices"] = glb.addIndices({0, 1, 65535});
  EXPECT_TRUE(refused(glb, {"it refers to vertex 65535"}));
  const std::size_t number = glb.addIndices({0, 1, 2});
  glb.primitive()["indices"] = number;
  const auto refusedWith = [&](const char* key, const Json& value) {
    Glb changed = glb;
    changed.accessor(number)[key] = value;
    EXPECT_TRUE(refused(changed, {"its indices, accessor ", "are not data of unsigned integers"}));
  };
  refusedWith("componentType", 5122);
  refusedWith("normalized", true);
  glb.accessor(number)["count"] = 1;
  refusedWith("type", "VEC3");
  glb.accessor(number).erase("bufferView");
  EXPECT_TRUE(refused(glb, {"are not data of unsigned integers"}));
}

TEST(GltfReader, MaterialsShareTextureCoordinatesThatTheyDoNotTransform) {
  Glb glb = smallFace();
  Json& primitives = glb.json["meshes"][0]["primitives"];
  for (int k = 0; k < 2; ++k) {
    Json more = primitives[0];
    more["material"] = glb.add("materials", glb.json["materials"][0]);
    primitives.push_back(more);
  }
  EXPECT_EQ(read(glb).rig.neutral.polygons.texcoords.size(), 9u);
  glb.json["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
  EXPECT_EQ(read(glb).rig.neutral.polygons.texcoords.size(), 18u);
}

TEST(GltfReader, MaterialsOfOneNameAreToldApart) {
  Glb glb = smallFace();
  Json& primitives = glb.json["meshes"][0]["primitives"];
  for (const char* name : {"skin", "skin 2", "skin"}) {
    Json more = primitives[0];
    more["material"] = glb.add("materials", {{"name", name}});
    primitives.push_back(more);
  }
  EXPECT_EQ(read(glb).rig.neutral.polygons.materials,
            (std::vector<std::string>{"skin", "skin 2", "skin 2 2", "skin 3"}));
}

// ---- Quads ----

/// The sheet with separate vertices for every triangle, each with a colour and a normal.
Glb soup(const std::function<float(std::size_t triangle, Vec3 at)>& colour) {
  std::vector<Vec3> positions, normals;
  std::vector<float> colours;
  for (const std::uint16_t v : sheetIndices()) {
    const std::size_t triangle = positions.size() / 3;
    positions.push_back(sheetPositions()[v]);
    normals.push_back(triangle % 2 ? Vec3{0, 0, 1} : Vec3{0, 1, 0});
    for (int k = 0; k < 3; ++k) colours.push_back(colour(triangle, positions.back()));
  }
  Glb glb = points(positions);
  Json& attributes = glb.primitive()["attributes"];
  attributes["NORMAL"] = glb.addVectors(normals);
  const std::size_t view = glb.addView(bytesOf(colours));
  attributes["COLOR_0"] = glb.addAccessor(view, 5126, "VEC3", positions.size());
  return glb;
}
Index faceCount(const Glb& glb) { return read(glb).rig.neutral.polygons.faceCount(); }

TEST(GltfReader, TrianglesOfDoubledVerticesMakeQuads) {
  EXPECT_EQ(faceCount(soup([](std::size_t, Vec3) { return 0.5f; })), 4);
  EXPECT_EQ(faceCount(soup([](std::size_t, Vec3 p) { return static_cast<float>(p.x); })), 4);
}

TEST(GltfReader, TrianglesMakeNoQuadsAcrossSeams) {
  EXPECT_EQ(faceCount(soup([](std::size_t t, Vec3) { return static_cast<float>(t); })), 8);
}

TEST(GltfReader, AttributesThatAreNotFiniteAreRefused) {
  EXPECT_TRUE(refused(soup([](std::size_t, Vec3) { return NAN; }), {"element 0 is not finite"}));
}

// ---- Attributes of faces ----

TEST(GltfReader, TextureCoordinatesHaveTheirOriginBelow) {
  const Polygons polygons = read(smallFace()).rig.neutral.polygons;
  ASSERT_EQ(polygons.cornerTexcoords.size(), polygons.corners.size());
  for (std::size_t c = 0; c < polygons.corners.size(); ++c) {
    const Vec3 p = sheetPositions()[polygons.corners[c]];
    const Vec2 t = polygons.texcoords[polygons.cornerTexcoords[c]];
    EXPECT_EQ(t, (Vec2{p.x / 2, 1 - p.y / 2}));
  }
}

TEST(GltfReader, TextureCoordinatesGoThroughTheTransformOfTheBaseColour) {
  Glb glb = smallFace();
  Json& texture = glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture = {{"index", 0}};
  texture["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", std::numbers::pi / 2}};
  const auto first = [](const Glb& face, std::size_t corner) {
    const Polygons polygons = read(face).rig.neutral.polygons;
    return polygons.texcoords[polygons.cornerTexcoords[corner]];
  };
  // A quarter turn takes (u, v) to (v, -u).
  const Vec3 p = sheetPositions()[read(glb).rig.neutral.polygons.corners[2]];
  EXPECT_NEAR(first(glb, 2).x, 0.5 + 4 * p.y / 2, 1e-12);
  EXPECT_NEAR(first(glb, 2).y, 1 - (0.25 - 2 * p.x / 2), 1e-12);

  Json& transform = texture["extensions"]["KHR_texture_transform"];
  transform["texCoord"] = 1;
  EXPECT_EQ(first(glb, 2), (Vec2{p.x / 2, 1 - p.y / 2}));
  transform["rotation"] = "none";
  EXPECT_TRUE(refused(glb, {"material 0: 'rotation' is not a number"}));
  transform = {{"scale", {1e308, 1e308}}, {"offset", {1e308, 1}}};
  EXPECT_TRUE(refused(glb, {"a TEXCOORD_0 is not finite where its texture is"}));
}

TEST(GltfReader, PartsMayLackTextureCoordinates) {
  Glb glb = smallFace();
  glb.primitive()["attributes"].erase("TEXCOORD_0");
  Polygons polygons = read(glb).rig.neutral.polygons;
  EXPECT_TRUE(polygons.texcoords.empty());
  EXPECT_TRUE(polygons.cornerTexcoords.empty());

  glb = smallFace();
  Json other = glb.primitive();
  other["attributes"].erase("TEXCOORD_0");
  glb.json["meshes"][0]["primitives"].push_back(other);
  polygons = read(glb).rig.neutral.polygons;
  EXPECT_EQ(polygons.texcoords.size(), 9u);
  EXPECT_EQ(polygons.cornerTexcoords[0], 0);
  EXPECT_EQ(polygons.cornerTexcoords.back(), -1);
}

TEST(GltfReader, TextureCoordinatesMustBePairs) {
  Glb glb = smallFace();
  glb.primitive()["attributes"]["TEXCOORD_0"] = 0;
  EXPECT_TRUE(refused(glb, {"accessor 0: a TEXCOORD_0 is not of type VEC2"}));
}

TEST(GltfReader, FacesHaveTheNamesOfMaterialsAndMeshes) {
  Glb glb = smallFace();
  glb.add("materials", {{"name", ""}});
  Json second = glb.primitive(), third = glb.primitive();
  second["material"] = 1;
  third.erase("material");
  glb.json["meshes"][0]["primitives"].push_back(second);
  glb.add("meshes",
          {{"primitives", Json::array({third})}, {"extras", {{"targetNames", {"open", "wink"}}}}});
  glb.add("nodes", {{"mesh", 1}});
  const Polygons polygons = read(glb).rig.neutral.polygons;
  EXPECT_EQ(polygons.materials, (std::vector<std::string>{"skin", "material_1"}));
  EXPECT_EQ(polygons.groups, (std::vector<std::string>{"head"}));
  std::set<std::pair<Index, Index>> pairs;
  for (std::size_t f = 0; f < polygons.faceMaterial.size(); ++f)
    pairs.emplace(polygons.faceMaterial[f], polygons.faceGroup[f]);
  EXPECT_EQ(pairs, (std::set<std::pair<Index, Index>>{{0, 0}, {1, 0}, {-1, -1}}));
}

// ---- Quads ----

TEST(GltfReader, JoinsTrianglesToQuads) {
  const Polygons polygons = read(smallFace()).rig.neutral.polygons;
  EXPECT_EQ(facesOf(polygons), (Faces{{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}}));
  EXPECT_EQ(polygons.faceMaterial, (std::vector<Index>{0, 0, 0, 0}));
  EXPECT_EQ(polygons.cornerTexcoords.size(), 16u);
}

/// The small face with a separate vertex for every corner of every triangle, and with `attributes`
/// besides positions and normals.
Glb loneTriangles(const std::vector<std::pair<const char*, std::vector<Vec2>>>& attributes) {
  Glb glb;
  std::vector<Vec3> positions, deltas, normals;
  for (const std::uint16_t v : sheetIndices()) {
    positions.push_back(sheetPositions()[v]);
    deltas.push_back(openDeltas()[v]);
    normals.push_back(normalized({1.0 * static_cast<double>(positions.size()), 1, 5}));
  }
  Json primitive = {
      {"attributes",
       {{"POSITION", glb.addVectors(positions)}, {"NORMAL", glb.addVectors(normals)}}},
      {"targets", Json::array({Json::object({{"POSITION", glb.addVectors(deltas)}})})}};
  for (const auto& [name, values] : attributes)
    primitive["attributes"][name] = glb.addTexcoords(values);
  glb.add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
  return glb;
}

TEST(GltfReader, JoinsTrianglesWhoseVerticesDifferInNormalsOnly) {
  std::vector<Vec2> places;
  for (const std::uint16_t v : sheetIndices())
    places.push_back({sheetPositions()[v].x, sheetPositions()[v].y});
  const auto faceCount = [](const Glb& glb) { return read(glb).rig.neutral.polygons.faceCount(); };
  EXPECT_EQ(faceCount(loneTriangles({})), 4);
  EXPECT_EQ(faceCount(loneTriangles({{"TEXCOORD_0", places}, {"TEXCOORD_1", places}})), 4);
  std::vector<Vec2> torn = places;
  for (std::size_t k = 0; k < 3; ++k) torn[k].x += 7;  // the first triangle
  EXPECT_EQ(faceCount(loneTriangles({{"TEXCOORD_0", torn}})), 5);
  EXPECT_EQ(faceCount(loneTriangles({{"TEXCOORD_0", places}, {"TEXCOORD_1", torn}})), 5);
}

TEST(GltfReader, TrianglesOfDifferentPrimitivesMakeNoQuads) {
  Glb glb = smallFace();
  Json half = glb.primitive();
  std::vector<std::uint16_t> indices[2];
  for (std::size_t k = 0; k < sheetIndices().size(); ++k)
    indices[k / 3 % 2].push_back(sheetIndices()[k]);
  glb.primitive()["indices"] = glb.addIndices(indices[0]);
  half["indices"] = glb.addIndices(indices[1]);
  glb.json["meshes"][0]["primitives"].push_back(half);
  EXPECT_EQ(faceCount(glb), 8);
}

// ---- Places ----

TEST(GltfReader, VerticesAreWhereTheFirstNodeShowsThem) {
  Glb glb = smallFace();
  glb.json["nodes"] = {{{"children", {1}}, {"scale", {2, 2, 2}}},
                       {{"mesh", 0}, {"translation", {0, 0, 1}}},
                       {{"mesh", 0}, {"translation", {7, 7, 7}}}};
  const RigSource source = read(glb);
  std::vector<Vec3> neutral, open;
  for (std::size_t v = 0; v < 9; ++v) {
    neutral.push_back(2 * (sheetPositions()[v] + Vec3{0, 0, 1}));
    open.push_back(neutral.back() + 2 * openDeltas()[v]);
  }
  expectNear(source.rig.neutral.positions, neutral);
  expectNear(source.rig.targets[0].positions, open);
}

void addSkin(Glb& glb) { glb.json["skins"] = {{{"joints", {glb.add("nodes", Json::object())}}}}; }

TEST(GltfReader, ASkinIgnoresWhereItsNodeIs) {
  Glb glb = smallFace();
  glb.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {7, 7, 7}}}};
  addSkin(glb);
  EXPECT_EQ(read(glb).rig.neutral.positions, sheetPositions());
}

TEST(GltfReader, WarnsWhereASkinUndoesAQuantization) {
  Glb glb = points(zigzag(3));
  const std::vector<std::int16_t> values{32767, -32767, 0, 0, 16384, 0, 0, 0, 0, 0, -32768, 0};
  glb.primitive()["attributes"]["POSITION"] =
      glb.addAccessor(glb.addView(bytesOf(values), 8), 5122, "VEC3", 3);
  glb.add("nodes", {{"mesh", 0}});
  EXPECT_TRUE(read(glb).faceWarnings.empty());
  addSkin(glb);
  glb.json["nodes"][0]["skin"] = 0;
  const auto warnings = read(glb).faceWarnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("units of the quantization, not of the scene"), std::string::npos);
}

/// The warnings about a face of points with these normals, but for those about which way they look.
std::vector<std::string> flatness(const std::vector<Vec3>& positions,
                                  const std::vector<Vec3>& normals) {
  Glb glb = points(positions);
  glb.primitive()["attributes"]["NORMAL"] = glb.addVectors(normals);
  std::vector<std::string> warnings = read(glb).faceWarnings;
  std::erase_if(warnings, [](const std::string& w) { return w.contains("made for shading"); });
  return warnings;
}

TEST(GltfReader, WarnsOfFlatShading) {
  std::vector<Vec3> positions = zigzag(3);
  std::ranges::copy(zigzag(3), std::back_inserter(positions));
  const auto warnings = [&](const Vec3& first, const Vec3& second) {
    std::vector<Vec3> normals(3, first);
    normals.resize(6, second);
    return flatness(positions, normals);
  };
  ASSERT_EQ(warnings({0, 0, 1}, {1, 0, 0}).size(), 1u);
  EXPECT_EQ(warnings({0, 0, 1}, {1, 0, 0})[0].find("At 3 of 3 places"), 0u);
  const auto turned = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3{std::sin(angle), 0, std::cos(angle)};
  };
  EXPECT_TRUE(warnings({0, 0, 1}, turned(25)).empty());
  EXPECT_EQ(warnings({0, 0, 1}, turned(35)).size(), 1u);
  EXPECT_TRUE(warnings({0, 0, 1}, {0, 0, -1}).empty());   // a doubled sheet
  EXPECT_TRUE(warnings({0, 0, 0}, {1, 0, 0}).empty());    // the first have none
  EXPECT_TRUE(warnings({0, 0, 1}, {NAN, 0, 0}).empty());  // they are not needed
  for (const int places : {80, 119}) {  // more and less than a hundredth of which is one
    std::vector<Vec3> rim = zigzag(places), normals(rim.size(), {0, 0, 1});
    rim.push_back(rim[0]), normals.push_back({1, 0, 0});
    EXPECT_EQ(flatness(rim, normals).size(), places < 100 ? 1u : 0u) << places;
  }
}

TEST(GltfReader, AMeshThatNoNodeShowsStaysWhereItIs) {
  Glb glb = smallFace();
  glb.json.erase("nodes");
  EXPECT_EQ(read(glb).rig.neutral.positions, sheetPositions());
}

TEST(GltfReader, FacesOfAMirroredMeshLookOutwardsStill) {
  Glb glb = points(zigzag(3));
  glb.add("nodes", {{"mesh", 0}, {"scale", {-1, 1, 1}}});
  EXPECT_EQ(facesOf(read(glb).rig.neutral.polygons), (Faces{{0, 2, 1}}));
}

TEST(GltfReader, PartsComeOneAfterTheOther) {
  Glb glb = smallFace();
  const std::size_t p = glb.addVectors(zigzag(3)), t = glb.addVectors(zigzag(3));
  Json jaw = {{"attributes", {{"POSITION", p}}}};
  jaw["targets"].push_back({{"POSITION", t}});
  glb.add("meshes", {{"primitives", Json::array({jaw})},
                     {"extras", {{"targetNames", Json::array({"jaw"})}}}});
  glb.add("nodes", {{"mesh", 1}});
  const RigSource source = read(glb);
  ASSERT_EQ(source.rig.neutral.positions.size(), 12u);
  ASSERT_EQ(source.rig.targets.size(), 3u);
  const auto moved = [&](std::size_t target, std::size_t v) {
    return source.rig.targets[target].positions[v] != source.rig.neutral.positions[v];
  };
  EXPECT_TRUE(moved(0, 5) && moved(2, 10));
  EXPECT_FALSE(moved(0, 10) || moved(1, 10) || moved(2, 5));
  EXPECT_EQ(facesOf(source.rig.neutral.polygons).back(), (std::vector<Index>{9, 10, 11}));
}

TEST(GltfReader, WhatIsTooFarAwayIsRefused) {
  Glb glb = smallFace();
  glb.json["nodes"][0]["scale"] = {1e39, 1e39, 1e39};
  EXPECT_TRUE(refused(glb, {"too far away for a float"}));
  glb = smallFace();
  std::vector<Vec3> far(9, Vec3{3e38, 0, 0});
  glb.primitive()["attributes"]["POSITION"] = glb.addVectors(far);
  glb.primitive()["targets"][0]["POSITION"] = glb.addVectors(far);
  EXPECT_TRUE(refused(glb, {"too far away for a float"}));
}

}  // namespace
}  // namespace sweepface
