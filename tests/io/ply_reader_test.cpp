#include <algorithm>
#include <bit>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

#include "sweepface/io.hpp"

#include "io/temporary_folder.hpp"

namespace sweepface {
namespace {

using testing::failsWith;

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string faceList = "property list uchar int vertex_indices\n";
const std::string quadElements = "element vertex 4\n" + xyz + "element face 2\n" + faceList;
const std::string quadRows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

std::string ply(const std::string& elements, const std::string& body,
                const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\ncomment by hand\n" + elements + "end_header\n" + body;
}

/// Builds the body of a binary file.
struct Bytes {
  bool bigEndian = false;
  std::string text{};

  template <typename T>
  Bytes& operator<<(T value) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (bigEndian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    text.append(raw.data(), raw.size());
    return *this;
  }
};

std::string quadBytes(bool bigEndian) {
  Bytes bytes{bigEndian};
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) bytes << c;
  bytes << std::uint8_t{3} << 0 << 1 << 2 << std::uint8_t{4} << 0 << 1 << 2 << 3;
  return bytes.text;
}

PolygonMesh plyMesh(const std::string& bytes) {
  auto mesh = parsePly(bytes, "a.ply");
  EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
  return mesh ? std::move(*mesh) : PolygonMesh{};
}

void expectQuad(const std::string& bytes) {
  const PolygonMesh mesh = plyMesh(bytes);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.polygons.faceStart, (std::vector<Index>{0, 3, 7}));
  EXPECT_EQ(mesh.polygons.corners, (std::vector<Index>{0, 1, 2, 0, 1, 2, 3}));
  EXPECT_EQ(mesh.polygons.faceGroup, (std::vector<Index>{-1, -1}));
  EXPECT_EQ(mesh.polygons.faceMaterial, (std::vector<Index>{-1, -1}));
  EXPECT_TRUE(mesh.polygons.cornerTexcoords.empty());
}

TEST(PlyReader, ReadsAscii) { expectQuad(ply(quadElements, quadRows)); }

TEST(PlyReader, ReadsBinaryOfEitherEndianness) {
  expectQuad(ply(quadElements, quadBytes(false), "binary_little_endian"));
  expectQuad(ply(quadElements, quadBytes(true), "binary_big_endian"));
}

TEST(PlyReader, ReadsAHeaderWithAnyLineBreak) {
  for (const std::string lineBreak : {"\r\n", "\r"}) {
    std::string header = ply(quadElements, "", "binary_little_endian");
    for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos;
         at += lineBreak.size())
      header.replace(at, 1, lineBreak);
    expectQuad(header + quadBytes(false));
  }
}

TEST(PlyReader, PassesOverObjInfo) {
  expectQuad(ply("obj_info scanned by hand\n" + quadElements, quadRows));
}

TEST(PlyReader, ReadsPositionsOfAnyScalarType) {
  const std::string types[] = {"char", "uint8",  "short",   "uint16",
                               "int",  "uint32", "float32", "double"};
  for (const std::string& type : types) {
    const std::string header = "element vertex 3\nproperty " + type + " x\nproperty " + type +
                               " y\nproperty " + type + " z\nelement face 1\n" + faceList;
    EXPECT_EQ(plyMesh(ply(header, "1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n")).positions[1], (Vec3{4, 5, 6}));
  }
  Bytes bytes;
  for (int i = 0; i < 3; ++i) bytes << std::int8_t{-1} << std::uint16_t{65535} << 0.1;
  bytes << std::uint8_t{3} << 0 << 1 << 2;
  const std::string header =
      "element vertex 3\nproperty int8 x\nproperty ushort y\nproperty float64 z\nelement face 1\n";
  EXPECT_EQ(plyMesh(ply(header + faceList, bytes.text, "binary_little_endian")).positions[2],
            (Vec3{-1, 65535, 0.1}));
}

TEST(PlyReader, SkipsOtherElementsAndProperties) {
  const std::string header =
      "element camera 2\nproperty list uchar float view\nproperty int id\n"
      "element nothing 4000000000\n"
      "element vertex 3\nproperty uchar red\nproperty list int int ring\n" +
      xyz +
      "element face 1\nproperty float area\n"
      "property list uint uint vertex_index\nproperty list uchar float normals\n"
      "element edge 1\nproperty int a\n";
  const std::string body =
      "2 0.5 0.5 7\n0 8\n9 0 1 2 3\n9 1 5 4 5 6\n9 2 5 5 7 8 9\n"
      "0.5 3 2 1 0 2 0 1\n1\n";
  const PolygonMesh mesh = plyMesh(ply(header, body));
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(mesh.polygons.corners, (std::vector<Index>{2, 1, 0}));
}

TEST(PlyReader, ReadsTextureCoordinatesOfVertices) {
  for (const auto& [u, v] : {std::pair{"s", "t"},
                             {"u", "v"},
                             {"texture_u", "texture_v"},
                             {"texture_s", "texture_t"},
                             {"texcoord_u", "texcoord_v"}}) {
    const std::string header = "element vertex 3\n" + xyz + "property float " + u +
                               "\nproperty float " + v + "\nelement face 1\n" + faceList;
    const Polygons polygons =
        plyMesh(ply(header, "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 2 1 0\n")).polygons;
    EXPECT_EQ(polygons.texcoords, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(polygons.cornerTexcoords, (std::vector<Index>{2, 1, 0}));
  }
}

TEST(PlyReader, TakesNoListsForTextureCoordinates) {
  const std::string header = "element vertex 3\n" + xyz +
                             "property list uchar float s\nproperty list uchar float t\n"
                             "element face 1\n" +
                             faceList;
  EXPECT_TRUE(plyMesh(ply(header, "0 0 0 1 5 1 5\n1 0 0 1 5 1 5\n0 1 0 1 5 1 5\n3 2 1 0\n"))
                  .polygons.texcoords.empty());
}

// The second face has none. The vertices have others, which only count if no face has any.
TEST(PlyReader, ReadsTextureCoordinatesOfCorners) {
  const std::string vertices =
      "element vertex 3\n" + xyz + "property float s\nproperty float t\nelement face 3\n";
  const std::string places = "0 0 0 9 9\n1 0 0 9 9\n0 1 0 9 9\n";
  const std::string texcoords = "property list uchar float texcoord\n";
  const std::string before = "6 0 0 1 0 0 1 3 0 1 2\n0 3 2 1 0\n6 0 1 1 0 0.5 0 3 2 1 0\n";
  const std::string behind = "3 0 1 2 6 0 0 1 0 0 1\n3 2 1 0 0\n3 2 1 0 6 0 1 1 0 0.5 0\n";
  for (const std::string& mesh : {ply(vertices + texcoords + faceList, places + before),
                                  ply(vertices + faceList + texcoords, places + behind)}) {
    const Polygons polygons = plyMesh(mesh).polygons;
    EXPECT_EQ(polygons.texcoords, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}}));
    EXPECT_EQ(polygons.cornerTexcoords, (std::vector<Index>{0, 1, 2, -1, -1, -1, 2, 1, 3}));
  }
  const Polygons ofVertices =
      plyMesh(ply(vertices + texcoords + faceList, places + "0 3 0 1 2\n0 3 2 1 0\n0 3 2 1 0\n"))
          .polygons;
  EXPECT_EQ(ofVertices.texcoords, (std::vector<Vec2>{{9, 9}, {9, 9}, {9, 9}}));
  EXPECT_EQ(ofVertices.cornerTexcoords, ofVertices.corners);
}

TEST(PlyReader, PassesOverAByteOrderMark) {
  expectQuad("\xef\xbb\xbf" + ply(quadElements, quadRows));
}

TEST(PlyReader, MayEndInBlankLinesOrABreak) {
  expectQuad(ply(quadElements, quadRows + "\n \n"));
  expectQuad(ply(quadElements, quadBytes(false) + "\n", "binary_little_endian"));
}

struct BadPly {
  std::string name, bytes;
  std::vector<std::string> says;
};

void PrintTo(const BadPly& bad, std::ostream* out) { *out << bad.name; }

class PlyErrors : public ::testing::TestWithParam<BadPly> {};

TEST_P(PlyErrors, NameTheFileThePlaceAndWhatIsWrong) {
  const auto mesh = parsePly(GetParam().bytes, "heads/a.ply");
  EXPECT_TRUE(failsWith(mesh, {"heads/a.ply"}));
  for (const std::string& part : GetParam().says) EXPECT_TRUE(failsWith(mesh, {part}));
}

INSTANTIATE_TEST_SUITE_P(
    Header, PlyErrors,
    ::testing::Values(
        BadPly{"EmptyFile", "", {"is empty"}}, BadPly{"Utf16", "\xff\xfep", {"UTF-16"}},
        BadPly{"StripsOnly",
               ply("element vertex 3\n" + xyz +
                       "element tristrips 1\nproperty list int int vertex_indices\n",
                   "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
               {"has no faces (element 'face'), but strips of triangles"}},
        BadPly{"NotAPly", "v 0 0 0\n", {"does not begin with a line 'ply'"}},
        BadPly{"HeaderCutShort",
               "ply\nformat ascii 1.0\nelement vertex 3\n",
               {"ends within its header", "line 3"}},
        BadPly{"NoFormat", "ply\n" + quadElements + "end_header\n" + quadRows, {"no format"}},
        BadPly{"UnknownFormat", ply(quadElements, quadRows, "utf8"), {"line 2", "'utf8'"}},
        BadPly{
            "UnknownVersion", "ply\nformat ascii 2.0\nend_header\n", {"line 2", "version '2.0'"}},
        BadPly{"UnknownStatement", ply("elment vertex 3\n", ""), {"line 4", "'elment'"}},
        BadPly{"UnknownType", ply("element vertex 1\nproperty half x\n", ""), {"line 5", "'half'"}},
        BadPly{"FloatCounts",
               ply("element face 1\nproperty list float int vertex_indices\n", ""),
               {"line 5", "'float'"}},
        BadPly{
            "NamelessProperty", ply("element face 1\nproperty int\n", ""), {"line 5", "no name"}},
        BadPly{"NegativeElements", ply("element vertex -3\n", ""), {"line 4", "'-3'"}},
        BadPly{"ElementsBeyondAll",
               ply("element vertex 99999999999999999999\n", ""),
               {"line 4", "'9999"}},
        BadPly{"EarlyProperty", ply(xyz, ""), {"line 4", "before any element"}},
        BadPly{"SecondVertexElement",
               ply("element vertex 1\nelement vertex 1\n", ""),
               {"line 5", "second element 'vertex'"}},
        BadPly{"SecondX",
               ply("element vertex 1\nproperty float x\nproperty int x\n", ""),
               {"line 6", "second property 'x' of the element 'vertex'"}},
        BadPly{"NoVertexElement", ply("element face 1\n" + faceList, "3 0 1 2\n"), {"no vertices"}},
        BadPly{"NoVertices", ply("element vertex 0\n" + xyz, ""), {"no vertices"}},
        BadPly{"NoZ",
               ply("element vertex 1\nproperty int x\nproperty int y\n", "0 0\n"),
               {"no vertex property 'z'"}},
        BadPly{
            "ListX",
            ply("element vertex 1\nproperty list int int x\nproperty int y\nproperty int z\n", ""),
            {"'x'"}},
        BadPly{"NoFaceElement", ply("element vertex 1\n" + xyz, "0 0 0\n"), {"no faces"}},
        BadPly{"NoFaceList",
               ply("element vertex 1\n" + xyz + "element face 1\nproperty int a\n", "0 0 0\n1\n"),
               {"without a list 'vertex_indices'"}},
        BadPly{"FloatIndices",
               ply("element vertex 1\n" + xyz +
                       "element face 1\nproperty list int float vertex_index\n",
                   "0 0 0\n1\n"),
               {"of integers"}}),
    [](const auto& tested) { return tested.param.name; });

std::string binary(const std::string& elements, const std::string& body) {
  return ply(elements, body, "binary_little_endian");
}

std::string oneFace(const std::string& countType, const std::string& body) {
  return binary(
      "element vertex 1\nproperty char x\nproperty char y\nproperty char z\n"
      "element face 1\nproperty list " +
          countType + " int vertex_index\n",
      std::string(3, '\0') + body);
}

/// A face with three corners `corner`, followed by more `vertices` than the file can hold.
std::string facesFirst(const std::string& vertices, std::uint32_t corner) {
  Bytes bytes;
  bytes << std::uint8_t{3} << corner << corner << corner;
  return binary("element face 1\nproperty list uchar uint vertex_index\nelement vertex " +
                    vertices + "\n" + xyz,
                bytes.text);
}

std::string rows(const std::string& body) { return ply(quadElements, body); }

INSTANTIATE_TEST_SUITE_P(
    Data, PlyErrors,
    ::testing::Values(
        BadPly{"MoreVerticesThanBytes",
               binary("element vertex 4000000000\n" + xyz, "0123"),
               {"promises 4000000000 of element 'vertex'", "only 4 bytes"}},
        BadPly{"MoreVerticesThanBytesBehindFaces",
               facesFirst("1000000000000000000", 4'000'000'000),
               {"promises 1000000000000000000 of element 'vertex'", "only 13 bytes"}},
        BadPly{"MoreSkippedThanBytes",
               binary("element a 18446744073709551615\nproperty char b\nelement vertex 1\n" + xyz,
                      "0123"),
               {"element 'a'"}},
        BadPly{"BinaryCutShort",
               binary(quadElements, quadBytes(false).substr(0, 77)),
               {"face 1", "byte", "claims 4 values, but the file ends before them"}},
        BadPly{"AsciiGoesOn",
               rows(quadRows + "3 0 1 2\n"),
               {"goes on (line 17) behind the 2 of element 'face'"}},
        BadPly{"BinaryGoesOn",
               binary(quadElements, quadBytes(false) + quadBytes(false)),
               {"goes on (byte", "behind the 2 of element 'face'"}},
        BadPly{"TexcoordsOfOtherCorners",
               ply("element vertex 3\n" + xyz + "element face 1\n" + faceList +
                       "property list uchar float texcoord\n",
                   "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 4 0 0 1 0\n"),
               {"face 0", "line 15", "'texcoord' has 4 numbers for 3 corners"}},
        BadPly{"NoTexcoord",
               ply("element vertex 3\n" + xyz + "element face 1\n" + faceList +
                       "property list uchar float texcoord\n",
                   "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 nan 1\n"),
               {"face 0", "not finite"}},
        BadPly{"BinaryFacesMissing",
               binary(quadElements, quadBytes(false).substr(0, 48)),
               {"element 'face'", "0 bytes"}},
        BadPly{"NegativeList",
               oneFace("char", "\xff" + std::string(12, '\0')),
               {"face 0", "claims -1"}},
        BadPly{"AbsurdList",
               oneFace("uint", std::string(16, '\xff')),
               {"face 0", "claims 4294967295"}},
        BadPly{"SmallFace",
               oneFace("uchar", "\2" + std::string(12, '\0')),
               {"face 0", "2 of the 3 corners"}},
        BadPly{"BinaryIndexTooFar",
               oneFace("uchar", "\3" + std::string(8, '\0') + "\1" + std::string(3, '\0')),
               {"face 0", "vertex 1,"}},
        BadPly{"AsciiCutShort",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"),
               {"face 1", "line 15", "ends before it"}},
        BadPly{"AsciiFacesMissing",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n"),
               {"promises 2 of element 'face'"}},
        BadPly{"AsciiValueMissing",
               rows("0 0 0\n1 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
               {"vertex 1", "line 12", "missing"}},
        BadPly{"AsciiValueTooMany",
               rows("0 0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
               {"vertex 0", "line 11", "more values"}},
        BadPly{"AsciiNoNumber",
               rows("0 0 0\n1 O 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
               {"vertex 1", "'O'"}},
        BadPly{"AsciiNan",
               rows("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
               {"vertex 1", "not finite"}},
        BadPly{"AsciiTooLarge",
               rows("0 0 0\n1 1e300 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n"),
               {"vertex 1", "too large"}},
        BadPly{"AsciiIndexTooFar",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n4 0 1 2 3\n"),
               {"face 0", "line 15", "vertex 4", "0 to 3"}},
        BadPly{"AsciiIndexNegative",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 -1\n4 0 1 2 3\n"),
               {"face 0", "vertex -1"}},
        BadPly{"AsciiIndexFraction",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 1.5\n4 0 1 2 3\n"),
               {"face 0", "'1.5' is not an integer"}},
        BadPly{"AsciiListTooLong",
               rows("0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2\n4 0 1 2 3\n"),
               {"face 0", "missing"}}),
    [](const auto& tested) { return tested.param.name; });

TEST(PlyErrors, NameTooManyElements) {
  std::string elements;
  for (int i = 0; i < 101; ++i) elements += "element e" + std::to_string(i) + " 0\n";
  EXPECT_TRUE(failsWith(parsePly(ply(elements, ""), "a.ply"), {"line 104", "more than 100"}));
}

TEST(PlyErrors, NameTooManyProperties) {
  std::string properties = "element vertex 0\n";
  for (int i = 0; i < 1001; ++i) properties += "property int p" + std::to_string(i) + "\n";
  EXPECT_TRUE(failsWith(parsePly(ply(properties, ""), "a.ply"), {"line 1005", "more than 1000"}));
}

TEST(PlyErrors, NameNonFiniteBinaryCoordinates) {
  Bytes bytes;
  bytes << 0.f << std::numeric_limits<float>::quiet_NaN() << 0.f;
  EXPECT_TRUE(failsWith(parsePly(binary("element vertex 1\n" + xyz, bytes.text), "a.ply"),
                        {"a.ply, vertex 0", "nan is not finite"}));
}

TEST(PlyReader, RefusesEveryCutOfAFile) {
  const std::string whole = binary(quadElements, quadBytes(false));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(failsWith(parsePly(whole.substr(0, size), "a.ply"), {"a.ply"})) << size;
}

}  // namespace
}  // namespace sweepface
