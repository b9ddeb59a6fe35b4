#include <fmt/format.h>
#include <meshoptimizer.h>

#include "gltf/accessor.hpp"
#include "gltf/glb.hpp"
#include "gltf/scene.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::string compressedVertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(count, stride));
  stream.resize(
      meshopt_encodeVertexBuffer(stream.data(), stream.size(), bytes.data(), count, stride));
  return bytesOf(stream);
}

std::string compressedTriangles(const std::vector<unsigned>& indices) {
  std::vector<unsigned char> stream(meshopt_encodeIndexBufferBound(indices.size(), 1000));
  stream.resize(
      meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), indices.size()));
  return bytesOf(stream);
}

std::string compressedSequence(const std::vector<unsigned>& indices) {
  std::vector<unsigned char> stream(meshopt_encodeIndexSequenceBound(indices.size(), 1000));
  stream.resize(
      meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), indices.size()));
  return bytesOf(stream);
}

/// Adds a compressed view, which stands in for a view of a buffer that does not exist.
std::size_t addCompressed(Glb& glb, const std::string& stream, std::size_t count,
                          std::size_t stride, const char* mode = "ATTRIBUTES",
                          const char* filter = nullptr,
                          const char* extension = "EXT_meshopt_compression") {
  const std::size_t plain = glb.addView(stream);
  Json told = {{"buffer", 0},
               {"byteOffset", glb.json["bufferViews"][plain]["byteOffset"]},
               {"byteLength", stream.size()},
               {"byteStride", stride},
               {"mode", mode},
               {"count", count}};
  if (filter) told["filter"] = filter;
  Json& view = glb.json["bufferViews"][plain];
  view = {{"buffer", 1}, {"byteOffset", 16}, {"byteLength", count * stride}};
  if (std::string_view(mode) == "ATTRIBUTES") view["byteStride"] = stride;
  view["extensions"][extension] = told;
  while (glb.json["buffers"].size() < 2) glb.json["buffers"].push_back(Json::object());
  glb.json["buffers"][1] = {{"byteLength", 1 << 20},
                            {"extensions", {{extension, {{"fallback", true}}}}}};
  glb.json["extensionsUsed"] = glb.json["extensionsRequired"] = Json::array({extension});
  return plain;
}

Result<std::vector<double>> decodeLast(const Glb& glb) {
  const auto document = gltf::parseDocument(glb.bytes(), {});
  if (!document) return std::unexpected(document.error());
  const auto accessor = gltf::accessorAt(*document, document->list("accessors").size() - 1);
  if (!accessor) return std::unexpected(accessor.error());
  return gltf::decode(*document, *accessor);
}

std::vector<std::int16_t> someShorts() {
  std::vector<std::int16_t> values;
  for (int k = 0; k < 4 * 300; ++k) values.push_back(static_cast<std::int16_t>(k * k % 4093 - 700));
  return values;
}

TEST(Meshopt, VerticesAreDecompressed) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    Glb glb;
    const std::string stream = compressedVertices(bytesOf(someShorts()), 300, 8);
    const std::size_t view = addCompressed(glb, stream, 300, 8, "ATTRIBUTES", nullptr, extension);
    glb.addAccessor(view, 5122, "VEC4", 300);
    const std::vector<std::int16_t> expected = someShorts();
    EXPECT_EQ(decodeLast(glb).value(), std::vector<double>(expected.begin(), expected.end()));
  }
}

TEST(Meshopt, TrianglesAndIndicesAreDecompressed) {
  const std::vector<unsigned> triangles{0, 1, 2, 2, 1, 3, 4, 5, 3}, sequence{9, 7, 8, 300, 2};
  Glb glb;
  glb.addAccessor(addCompressed(glb, compressedTriangles(triangles), 9, 2, "TRIANGLES"), 5123,
                  "SCALAR", 9);
  EXPECT_EQ(decodeLast(glb).value(), std::vector<double>(triangles.begin(), triangles.end()));
  glb.addAccessor(addCompressed(glb, compressedSequence(sequence), 5, 4, "INDICES"), 5125, "SCALAR",
                  5);
  EXPECT_EQ(decodeLast(glb).value(), std::vector<double>(sequence.begin(), sequence.end()));
}

TEST(Meshopt, FiltersAreUndone) {
  const std::vector<float> directions{0, 0, 1, 0, 1, 0, 0, 0, 0, 0.6f, 0.8f, 0};
  std::vector<std::int16_t> octahedral(12);
  meshopt_encodeFilterOct(octahedral.data(), 3, 8, 16, directions.data());
  Glb glb;
  std::size_t view = addCompressed(glb, compressedVertices(bytesOf(octahedral), 3, 8), 3, 8,
                                   "ATTRIBUTES", "OCTAHEDRAL");
  glb.addAccessor(view, 5122, "VEC4", 3);
  glb.accessor(0)["normalized"] = true;
  auto values = decodeLast(glb).value();
  for (const std::size_t k : {0, 1, 2, 4, 5, 6, 8, 9, 10})
    EXPECT_NEAR(values[k], directions[k], 1e-4) << k;

  const std::vector<float> turn{0.5f, -0.5f, 0.5f, 0.5f};
  std::vector<std::int16_t> quaternion(4);
  meshopt_encodeFilterQuat(quaternion.data(), 1, 8, 16, turn.data());
  view = addCompressed(glb, compressedVertices(bytesOf(quaternion), 1, 8), 1, 8, "ATTRIBUTES",
                       "QUATERNION");
  glb.addAccessor(view, 5122, "VEC4", 1);
  glb.accessor(1)["normalized"] = true;
  values = decodeLast(glb).value();
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(std::abs(values[k]), 0.5, 1e-3);

  const std::vector<float> numbers{1.5f, -0.001f, 12345, 3};
  std::vector<std::uint32_t> exponential(4);
  meshopt_encodeFilterExp(exponential.data(), 2, 8, 20, numbers.data());
  view = addCompressed(glb, compressedVertices(bytesOf(exponential), 2, 8), 2, 8, "ATTRIBUTES",
                       "EXPONENTIAL");
  glb.addAccessor(view, 5126, "VEC2", 2);
  values = decodeLast(glb).value();
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(values[k], numbers[k], 1e-3 * std::abs(values[k]));
}

TEST(Meshopt, BoundsAreThoseOfWhatAFilterRounded) {
  const std::vector<float> numbers{0.123456f, -9.87654f, 5.4321f, 0.777777f, 2.345678f, -1.2345f};
  std::vector<std::uint32_t> exponential(6);
  meshopt_encodeFilterExp(exponential.data(), 3, 8, 6, numbers.data());
  const std::string stream = compressedVertices(bytesOf(exponential), 3, 8);
  Glb glb;
  const std::size_t rounded = addCompressed(glb, stream, 3, 8, "ATTRIBUTES", "EXPONENTIAL"),
                    exact =
                        addCompressed(glb, compressedVertices(floatsOf({{1, 2, 3}}), 1, 12), 1, 12);
  for (const char* bound : {"min", "max"}) {
    glb.accessor(glb.addAccessor(exact, 5126, "VEC3", 1))[bound] = {7, 7, 7};
    glb.accessor(glb.addAccessor(rounded, 5126, "VEC2", 3))[bound] = {7, 7};
  }
  const auto values = decodeLast(glb).value();
  const auto document = gltf::parseDocument(glb.bytes(), {});
  const Json& accessors = document->list("accessors");
  EXPECT_EQ(accessors[0]["min"], Json({7, 7, 7})) << "nothing was rounded";
  EXPECT_EQ(accessors[1]["min"], Json({std::min({values[0], values[2], values[4]}),
                                       std::min({values[1], values[3], values[5]})}));
  EXPECT_EQ(accessors[3]["max"], Json({std::max({values[0], values[2], values[4]}),
                                       std::max({values[1], values[3], values[5]})}));
  EXPECT_FALSE(accessors[1].contains("max") || accessors[3].contains("min"));
}

/// The small face with the accessor of its target "open" compressed.
Glb compressedFace() {
  Glb glb = smallFace();
  const std::size_t open = glb.primitive()["targets"][0]["POSITION"].get<std::size_t>();
  glb.accessor(open)["bufferView"] =
      addCompressed(glb, compressedVertices(floatsOf(openDeltas()), 9, 12), 9, 12);
  return glb;
}

TEST(Meshopt, AFaceIsReadAsIfItWereNotCompressed) {
  const RigSource plain = read(smallFace()), source = read(compressedFace());
  EXPECT_EQ(source.rig.targets[0].positions, plain.rig.targets[0].positions);
}

TEST(Meshopt, ASceneIsNotCompressed) {
  Glb glb = compressedFace();
  const Json& view = glb.json["bufferViews"][glb.attribute("TEXCOORD_0")["bufferView"].get<int>()];
  const std::string plain = glb.binary.substr(view["byteOffset"].get<std::size_t>(), 9 * 8);
  const std::size_t compressed = addCompressed(glb, compressedVertices(plain, 9, 8), 9, 8);
  glb.primitive()["attributes"]["TEXCOORD_1"] = glb.addAccessor(compressed, 5126, "VEC2", 9);
  const auto scene = gltf::parseScene(read(glb).scene);
  ASSERT_TRUE(scene) << scene.error().message;
  const std::string text = scene->json.dump();
  EXPECT_EQ(text.find("meshopt"), std::string::npos) << text;
  ASSERT_EQ(scene->buffers.size(), 1u);
  EXPECT_EQ(scene->buffers[0], plain);
}

/// Some exporters put the fallback buffer of compressed data first.
TEST(Meshopt, ASceneHasNoBufferThatStandsInForOthers) {
  const Glb glb = compressedFace();
  Json json = glb.json;
  for (Json& view : json["bufferViews"]) {
    view["buffer"] = 1 - view["buffer"].get<int>();
    if (view.contains("extensions")) view["extensions"]["EXT_meshopt_compression"]["buffer"] = 1;
  }
  std::string uri = "data:application/octet-stream,";
  for (const unsigned char c : glb.binary) uri += fmt::format("%{:02x}", c);
  const Json standIn = json["buffers"][1];
  json["buffers"] = Json::array({standIn, {{"byteLength", glb.binary.size()}, {"uri", uri}}});
  const auto source = parseGltf(json.dump(), "face.gltf", {});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(source->rig.targets[0].positions, read(smallFace()).rig.targets[0].positions);
  EXPECT_EQ(gltf::parseScene(source->scene)->json.dump().find("meshopt"), std::string::npos);
}

TEST(Meshopt, WhatTheExtensionSaysMustMakeSense) {
  const auto expectRefused = [](const char* key, const Json& value, std::string_view why) {
    Glb glb = compressedFace();
    Json& view = glb.json["bufferViews"].back();
    view["extensions"]["EXT_meshopt_compression"][key] = value;
    EXPECT_TRUE(refused(glb, {"buffer view ", why})) << key << value;
  };
  expectRefused("buffer", 2, "'buffer' is 2, but the file has 2 buffers");
  expectRefused("buffer", 1, "reaches beyond the 0 bytes of buffer 1");
  expectRefused("byteOffset", 1 << 20, "reaches beyond");
  expectRefused("byteLength", 1 << 20, "reaches beyond");
  expectRefused("byteLength", 0, "0 bytes of compressed view cannot hold 9 elements");
  expectRefused("byteStride", 10, "not 4, 8, ... 256");
  expectRefused("byteStride", 0, "not 4, 8, ... 256");
  expectRefused("byteStride", 260, "not 4, 8, ... 256");
  expectRefused("count", 0, "a count of 0");
  expectRefused("count", 90, "is damaged");
  expectRefused("count", 4'000'000'000, "cannot hold 4000000000 elements");
  expectRefused("count", 9007199254740991, "cannot hold");
  expectRefused("mode", "POINTS", "mode of a compressed view is missing or unknown");
  expectRefused("mode", "INDICES", "neither 2 nor 4");
  expectRefused("filter", "COLOR", "the filter 'COLOR' of a compressed view is unknown");
  expectRefused("filter", "OCTAHEDRAL", "OCTAHEDRAL has a byteStride not 4 or 8");
  expectRefused("filter", "QUATERNION", "QUATERNION has a byteStride other than 8");
  expectRefused("filter", 1, "'filter' is not a text");
}

TEST(Meshopt, NoViewCanBeOfWhatAnotherHoldsCompressed) {
  Glb glb = compressedFace();
  glb.add("bufferViews", {{"buffer", 2}, {"byteLength", 4}});
  EXPECT_TRUE(refused(glb, {"'buffer' is 2, but the file has 2 buffers"}));
}

TEST(Meshopt, TriangleCountsAndFiltersAreChecked) {
  const auto refusedWith = [](std::size_t count, const char* filter, std::string_view why) {
    Glb glb = smallFace();
    addCompressed(glb, compressedTriangles({0, 1, 2}), count, 2, "TRIANGLES", filter);
    EXPECT_TRUE(refused(glb, {why}));
  };
  refusedWith(4, nullptr, "not a multiple of 3");
  refusedWith(3, "EXPONENTIAL", "compressed indices have a filter");
  refusedWith(300'000, nullptr, "cannot hold 300000 elements");
}

TEST(Meshopt, NewerVersionsAreRefusedWithAWayOut) {
  Glb glb = compressedFace();
  const std::size_t at = glb.json["bufferViews"]
                             .back()["extensions"]["EXT_meshopt_compression"]["byteOffset"]
                             .get<std::size_t>();
  glb.binary[at] = static_cast<char>(0xA1);
  const auto source = parse(glb);
  if (source) GTEST_SKIP() << "this meshoptimizer reads version 1";
  // What newer libraries read is damaged here.
  glb.binary[at] = static_cast<char>(0xAF);
  EXPECT_TRUE(refused(glb, {"compressed with version 15 of meshopt", "npx gltfpack"}));
  glb.binary[at] = 0;
  EXPECT_TRUE(refused(glb, {"what it holds compressed is damaged"}));
}

TEST(Meshopt, EveryTruncationAndManyChangesOfAStreamAreSafe) {
  const Glb whole = compressedFace();
  const Json& view = whole.json["bufferViews"].back();
  const Json& told = view["extensions"]["EXT_meshopt_compression"];
  const auto at = told["byteOffset"].get<std::size_t>(),
             size = told["byteLength"].get<std::size_t>();
  for (std::size_t shorter = 1; shorter < size; ++shorter) {
    Glb glb = whole;
    glb.json["bufferViews"].back()["extensions"]["EXT_meshopt_compression"]["byteLength"] = shorter;
    EXPECT_TRUE(refused(glb, {"buffer view "})) << shorter;
  }
  for (std::size_t bit = 0; bit < 8 * size; ++bit) {
    Glb glb = whole;
    glb.binary[at + bit / 8] ^= static_cast<char>(1 << bit % 8);
    const auto source = parse(glb);
    EXPECT_TRUE(source || refused(glb, {"face.glb: "}));
  }
}

TEST(Meshopt, BytesThatManyViewsShareAreRefused) {
  Glb glb = compressedFace();
  const Json view = glb.json["bufferViews"].back();
  for (int k = 0; k < 100; ++k) glb.add("bufferViews", view);
  EXPECT_TRUE(refused(glb, {"its bytes are those of other compressed views"}));
}

}  // namespace
}  // namespace sweepface
