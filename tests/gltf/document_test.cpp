#include "gltf/document.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::string readBytes(const std::string& bytes) {
  const auto source = parseGltf(bytes, "face.glb", {});
  return source ? "" : source.error().message;
}

// ---- The container ----

TEST(Container, GivesBackWhatItWasMadeOf) {
  const Glb glb = smallFace();
  const auto document = gltf::parseDocument(glb.bytes(), {});
  ASSERT_TRUE(document) << document.error().message;
  ASSERT_EQ(document->buffers.size(), 1u);
  EXPECT_EQ(document->buffers[0], glb.binary);
  Json expected = glb.json;
  expected["buffers"].push_back({{"byteLength", glb.binary.size()}});
  EXPECT_EQ(document->json, expected);
}

TEST(Container, KeepsTheOrderOfMembers) {
  Glb glb = smallFace();
  glb.json["extras"] = Json::object({{"z", 1}, {"a", 2}, {"m", 3}});
  const auto document = gltf::parseDocument(glb.bytes(), {});
  EXPECT_EQ(document->json["extras"].dump(), R"({"z":1,"a":2,"m":3})");
}

TEST(Container, ChunksOfUnknownKindsArePassedOverWithAWarning) {
  std::string bytes = smallFace().bytes();
  bytes += std::string("\4\0\0\0HAIRabcd", 12);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(&bytes[8], &size, 4);
  const auto source = parseGltf(bytes, "face.glb", {});
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_EQ(source->warnings.size(), 1u);
  EXPECT_NE(source->warnings[0].find("unknown kinds"), std::string::npos);
}

TEST(Container, OnlyASecondChunkOfBytesIsThatOfTheBuffer) {
  std::string bytes = smallFace().bytes();
  bytes.replace(bytes.find(std::string("BIN\0", 4)), 4, "HAIR");
  EXPECT_TRUE(failsWith(parseGltf(bytes, "face.glb", {}), {"beyond the 0 bytes of buffer 0"}));
}

TEST(Container, EveryTruncationIsRefused) {
  const std::string bytes = smallFace().bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_TRUE(failsWith(parseGltf(bytes.substr(0, size), "face.glb", {}), {"face.glb: "}))
        << size;
}

TEST(Container, EveryTruncationThatTheHeaderTellsIsRefused) {
  const std::string bytes = smallFace().bytes();
  for (std::size_t size = 20; size < bytes.size(); ++size) {
    std::string shorter = bytes.substr(0, size);
    const auto told = static_cast<std::uint32_t>(size);
    std::memcpy(&shorter[8], &told, 4);
    EXPECT_TRUE(failsWith(parseGltf(shorter, "face.glb", {}), {"face.glb: "})) << size;
  }
}

TEST(Container, MessagesSayWhatIsWrong) {
  const std::string bytes = smallFace().bytes();
  const auto with = [&](std::size_t at, char value) {
    std::string changed = bytes;
    changed[at] = value;
    return readBytes(changed);
  };
  const auto says = [](const std::string& message, std::string_view what) {
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  says(readBytes(""), "face.glb: it is empty; export the file again.");
  says(readBytes("glTF"), "the file ends within its header; copy the file again");
  says(with(4, 1), "it is a GLB of version 1, not 2; export it as glTF 2.0.");
  says(with(8, 0), "its header says that it has ");
  says(with(16, 'X'), "its first chunk is not the JSON");
  says(with(15, 1), "the file ends within a chunk");
  says(readBytes("v 0 0 0\n"), "its JSON, line 1: this is not JSON, at column 1: 'v 0 0 0");
  says(readBytes("{\n\"asset\": {,}"), "its JSON, line 2: this is not JSON, at column 11: ',}'.");
  says(readBytes("[]"), "its JSON is not an object");
}

// ---- JSON ----

std::string nested(std::size_t levels, const std::string& open, const std::string& close) {
  std::string text = R"({"asset":{"version":"2.0"},"extras":)";
  for (std::size_t k = 0; k < levels; ++k) text += open;
  text += "1";
  for (std::size_t k = 0; k < levels; ++k) text += close;
  return text + "}";
}

TEST(Text, TenThousandLevelsAreRefused) {
  EXPECT_NE(readBytes(nested(10'000, "[", "]")).find("nested deeper than"), std::string::npos);
  EXPECT_NE(readBytes(nested(10'000, "{\"a\":", "}")).find("nested deeper than"),
            std::string::npos);
  EXPECT_NE(readBytes(std::string(10'000, '[')).find("nested deeper than"), std::string::npos);
  EXPECT_NE(readBytes(nested(100, "[", "]")).find("no triangles"), std::string::npos);
}

TEST(Text, BracketsWithinTextsAreNotLevels) {
  Glb glb = smallFace();
  glb.json["extras"] = std::string(10'000, '[') + "\"\\" + std::string(10'000, '{');
  EXPECT_TRUE(parse(glb));
}

TEST(Text, AnObjectOfVeryManyMembersIsRefusedAtOnce) {
  std::string text = R"({"asset":{"version":"2.0"},"extras":{)";
  for (int k = 0; k < 300'000; ++k) text += fmt::format("\"{:08}\":0,", k);
  EXPECT_NE(readBytes(text + "\"x\":0}}").find("more than 4096 members"), std::string::npos);
}

TEST(Text, NumbersThatNoDoubleHoldsAreRefused) {
  EXPECT_NE(readBytes(R"({"asset":{"version":"2.0"},"extras":1e999})").find("too large to be held"),
            std::string::npos);
  EXPECT_NE(readBytes(R"({"asset":{"version":"2.0"},"extras":NaN})")
                .find("this is not JSON, at column 37: 'NaN}'"),
            std::string::npos);
}

TEST(Text, MayBeginWithAByteOrderMarkAndEndInZeros) {
  Glb glb = smallFace();
  glb.json["buffers"] = {{{"uri",
                           "data:;base64,"
                           "AAAA"},
                          {"byteLength", 3}}};
  EXPECT_NE(readBytes("\xEF\xBB\xBF" + glb.text("data:,") + std::string(3, '\0')).find("buffer 0"),
            std::string::npos);
}

// ---- The asset ----

TEST(Asset, OtherVersionsAreRefused) {
  Glb glb = smallFace();
  glb.json["asset"]["version"] = "1.0";
  EXPECT_TRUE(refused(glb, {"it is of glTF version '1.0', not 2.0"}));
  glb.json["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
  EXPECT_TRUE(refused(glb, {"version '2.1'"}));
  glb.json["asset"] = {{"version", "2.1"}};
  EXPECT_TRUE(parse(glb));
  glb.json["asset"] = {{"version", 2}};
  EXPECT_TRUE(refused(glb, {"asset: 'version' is not a text"}));
  glb.json["asset"] = 7;
  EXPECT_TRUE(refused(glb, {"asset: it is not an object"}));
  glb.json.erase("asset");
  EXPECT_TRUE(refused(glb, {"it has no 'asset'"}));
}

TEST(Asset, ListsMustBeListsOfObjects) {
  for (const char* list : {"accessors", "bufferViews", "buffers", "meshes", "nodes", "materials",
                           "images", "skins", "animations", "scenes", "textures"})
    for (const Json& wrong : {Json(1), Json("x"), Json::object(), Json::array({1}), Json()}) {
      Glb glb = smallFace();
      glb.json[list] = wrong;
      const std::string bytes = gltf::formatContainer(glb.json, glb.binary);
      EXPECT_TRUE(failsWith(parseGltf(bytes, "face.glb", {}), {"face.glb: ", list})) << list;
    }
}

TEST(Asset, ExtensionsThatMoveNothingAreCarried) {
  for (const char* name :
       {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp", "KHR_lights_punctual",
        "KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    Glb glb = smallFace();
    glb.json["extensionsUsed"] = glb.json["extensionsRequired"] = {name};
    EXPECT_TRUE(parse(glb)) << name;
  }
}

TEST(Asset, OtherRequiredExtensionsAreRefused) {
  Glb glb = smallFace();
  glb.json["extensionsRequired"] = {"EXT_hair"};
  EXPECT_TRUE(refused(glb, {"it requires the extension 'EXT_hair'", "export it without"}));
  glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_TRUE(refused(glb, {"Draco", "npx @gltf-transform/cli copy IN.glb OUT.glb"}));
  glb.json["extensionsRequired"] = {7};
  EXPECT_TRUE(refused(glb, {"'extensionsRequired' is not a list of names"}));
  glb.json["extensionsRequired"] = "all";
  EXPECT_TRUE(refused(glb, {"'extensionsRequired' is not a list"}));
}

TEST(Asset, DracoIsRefusedWhereItIsNotSaidToBeRequired) {
  Glb glb = smallFace();
  glb.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
  EXPECT_TRUE(refused(glb, {"Draco"}));
}

// ---- Buffers and views ----

TEST(Buffers, MustHoldWhatTheyPromise) {
  Glb glb = smallFace();
  glb.json["buffers"] = {{{"byteLength", glb.binary.size() + 5}}};
  EXPECT_TRUE(refused(glb, {"buffer 0: it has ", " of its "}));
  glb.json["buffers"] = {{{"byteLength", -1}}};
  EXPECT_TRUE(refused(glb, {"buffer 0: 'byteLength' is not a whole number"}));
  glb.json["buffers"] = {{{"byteLength", "many"}}};
  EXPECT_TRUE(refused(glb, {"buffer 0: 'byteLength' is not a whole number"}));
  glb.json["buffers"] = {{{"byteLength", 1e15}}};
  EXPECT_TRUE(refused(glb, {"buffer 0: it has "}));
}

TEST(Buffers, ViewsMustLieWithinThem) {
  const std::size_t huge = std::size_t{1} << 52;
  const auto refusedView = [&](const char* key, const Json& value, std::string_view why) {
    Glb glb = smallFace();
    glb.json["bufferViews"][2][key] = value;
    EXPECT_TRUE(refused(glb, {"buffer view 2: ", why})) << key;
  };
  refusedView("buffer", 1, "'buffer' is 1, but the file has 1 buffers");
  refusedView("buffer", -1, "'buffer' is not a whole number");
  refusedView("byteOffset", 100'000, "reaches beyond the ");
  refusedView("byteOffset", huge, "reaches beyond the ");
  refusedView("byteLength", huge, "reaches beyond the ");
  refusedView("byteLength", 0, "its byteLength is 0");
  refusedView("byteLength", 1.5, "'byteLength' is not a whole number");
  refusedView("byteStride", 256, "byteStride is larger than 252");
  refusedView("byteStride", Json::array(), "'byteStride' is not a whole number");
}

TEST(Buffers, AreReadFromDataUris) {
  Glb glb = smallFace();
  std::string escaped = "data:application/octet-stream,";
  for (const unsigned char c : glb.binary) escaped += fmt::format("%{:02x}", c);
  const auto source = parseGltf(glb.text(escaped), "face.gltf", {});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(source->rig.neutral.positions, sheetPositions());
}

TEST(Buffers, Base64MayLackItsPaddingAndBeThatOfUrls) {
  const auto bytesOf = [](const std::string& uri, std::size_t size) {
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"{}"}}]}})", size, uri);
    const auto document = gltf::parseDocument(text, {});
    return document ? document->buffers[0] : document.error().message;
  };
  EXPECT_EQ(bytesOf("data:;base64,aGVsbG8=", 5), "hello");
  EXPECT_EQ(bytesOf("DATA:application/gltf-buffer;base64,aGVsbG8", 5), "hello");
  EXPECT_EQ(bytesOf("data:;base64,+/-_", 3), "\xFB\xFF\xBF");
  EXPECT_EQ(bytesOf("data:,he%6C%6co", 5), "hello");
  EXPECT_NE(bytesOf("data:;base64,aGVs*G8=", 5).find("not valid base64"), std::string::npos);
  EXPECT_NE(bytesOf("data:;base64,aGVsb", 3).find("not valid base64"), std::string::npos);
  EXPECT_NE(bytesOf("data:,%4", 1).find("not valid percent-encoded"), std::string::npos);
  EXPECT_NE(bytesOf("data:hello", 5).find("no comma"), std::string::npos);
  EXPECT_NE(bytesOf("data:,hell", 5).find("it has 4 of its 5 bytes"), std::string::npos);
}

// ---- Files beside the glTF ----

class Files : public ::testing::Test {
 protected:
  Result<RigSource> readAs(std::string_view uri) {
    return parseGltf(smallFace().text(uri), "face.gltf", folder / "home");
  }
  void SetUp() override {
    folder.file("home/face.bin", smallFace().binary);
    folder.file("home/deeper/a face.bin", smallFace().binary);
    folder.file("secret.bin", smallFace().binary);
  }
  TemporaryFolder folder;
};

TEST_F(Files, AreReadFromTheFolderAndBelow) {
  for (const char* uri : {"face.bin", "./face.bin", "deeper/a%20face.bin", "deeper/a face.bin"}) {
    const auto source = readAs(uri);
    ASSERT_TRUE(source) << source.error().message;
    EXPECT_EQ(source->rig.neutral.positions, sheetPositions());
  }
}

TEST_F(Files, ElsewhereAreNotRead) {
  for (const std::string& uri : std::initializer_list<std::string>{
           "../secret.bin", "deeper/../../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin",
           "deeper/../face.bin", (folder / "secret.bin").string(), "/etc/passwd", "//etc/passwd",
           "file:///etc/passwd", "http://example.org/face.bin", "c:/face.bin", "..\\secret.bin",
           "face.bin%00", "face.bin%zz", ""})
    EXPECT_TRUE(failsWith(readAs(uri), {"face.gltf: buffer 0: the file ", "folder of the glTF"}))
        << uri;
}

TEST_F(Files, ThatAreMissingOrNoFilesAreRefused) {
  EXPECT_TRUE(failsWith(readAs("nothing.bin"), {"'nothing.bin' cannot be read"}));
  EXPECT_TRUE(failsWith(readAs("deeper"), {"'deeper' is not a file"}));
  EXPECT_TRUE(failsWith(readAs("."), {"'.' is not a file"}));
  EXPECT_TRUE(failsWith(parseGltf(smallFace().text("face.bin"), "face.gltf", {}),
                        {"'face.bin' is not read here"}));
}

/// The small face with its texture coordinates in a second buffer, of the same file.
Glb faceOfTwoBuffers(std::string_view uri) {
  Glb glb = smallFace();
  glb.json["buffers"] = {Json::object(), {{"byteLength", glb.binary.size()}, {"uri", uri}}};
  const std::size_t view = glb.attribute("TEXCOORD_0")["bufferView"];
  glb.json["bufferViews"][view]["buffer"] = 1;
  return glb;
}

TEST_F(Files, MayBeSharedByBuffers) {
  const std::string uri = "face.bin", text = faceOfTwoBuffers(uri).text(uri);
  const auto source = parseGltf(text, "face.gltf", folder / "home");
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(source->rig.neutral.positions, sheetPositions());
  EXPECT_EQ(source->rig.neutral.polygons.texcoords,
            read(smallFace()).rig.neutral.polygons.texcoords);
  EXPECT_EQ(source->scene, read(smallFace()).scene);
  const auto document = gltf::parseDocument(text, folder / "home");
  EXPECT_EQ(document->sourceBytes, text.size() + smallFace().binary.size()) << "read once";
}

#ifndef _WIN32  // links are for administrators there, and pipes have no names among files

TEST_F(Files, AreReadOnceHoweverTheyAreSpelt) {
  Glb glb = faceOfTwoBuffers("%66ace.bin");
  std::filesystem::create_symlink("face.bin", folder / "home/link.bin");
  for (const char* uri : {"./face.bin", "link.bin"})
    glb.add("buffers", {{"byteLength", 4}, {"uri", uri}});
  const std::string text = glb.text("face.bin");
  const auto document = gltf::parseDocument(text, folder / "home");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_EQ(document->sourceBytes, text.size() + smallFace().binary.size());
}

TEST_F(Files, AreNotReadThroughLinksOutOfTheFolder) {
  std::filesystem::create_symlink("../secret.bin", folder / "home/link.bin");
  std::filesystem::create_directory_symlink("..", folder / "home/up");
  EXPECT_TRUE(failsWith(readAs("link.bin"), {"is a link out of the folder"}));
  EXPECT_TRUE(failsWith(readAs("up/secret.bin"), {"is a link out of the folder"}));
  std::filesystem::create_symlink("face.bin", folder / "home/same.bin");
  EXPECT_TRUE(readAs("same.bin"));
}

TEST_F(Files, ThatArePipesAreRefused) {
  ASSERT_EQ(mkfifo((folder / "home/pipe.bin").c_str(), 0600), 0);
  EXPECT_TRUE(failsWith(readAs("pipe.bin"), {"'pipe.bin' is not a file"}));
}

#endif

TEST_F(Files, ThatBuffersShareEndWhereEachSays) {
  Glb glb = faceOfTwoBuffers("face.bin");
  glb.json["buffers"][1]["byteLength"] = 8;
  EXPECT_TRUE(failsWith(parseGltf(glb.text("face.bin"), "face.gltf", folder / "home"),
                        {"reaches beyond the 8 bytes of buffer 1"}));
  glb.json["buffers"][1]["byteLength"] = 1 << 20;
  EXPECT_TRUE(failsWith(parseGltf(glb.text("face.bin"), "face.gltf", folder / "home"),
                        {"buffer 1: it has ", " of its 1048576 bytes"}));
}

TEST(Buffers, MayBeTheSameDataUri) {
  std::string uri = "data:,";
  for (const unsigned char c : smallFace().binary) uri += fmt::format("%{:02x}", c);
  const auto source = parseGltf(faceOfTwoBuffers(uri).text(uri), "face.gltf", {});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(source->scene, read(smallFace()).scene);
}

}  // namespace
}  // namespace sweepface
