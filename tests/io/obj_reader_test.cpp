#include <gtest/gtest.h>

#include "sweepface/io.hpp"

#include "io/temporary_folder.hpp"

namespace sweepface {
namespace {

using testing::failsWith;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonMesh objMesh(const std::string& text) {
  auto mesh = parseObj(text, "a.obj");
  EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
  return mesh ? std::move(*mesh) : PolygonMesh{};
}

std::vector<Index> cornersOf(const std::string& text) { return objMesh(text).polygons.corners; }

TEST(ObjReader, ReadsPositionsAndPolygonsOfAnySize) {
  const PolygonMesh mesh = objMesh(square + "v 0.5 -2e-1 +3\nf 1 2 3\nf 1 2 3 4\nf 1 5 2 3 4\n");
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.positions[4], (Vec3{0.5, -0.2, 3}));
  EXPECT_EQ(mesh.polygons.faceStart, (std::vector<Index>{0, 3, 7, 12}));
  EXPECT_EQ(mesh.polygons.corners, (std::vector<Index>{0, 1, 2, 0, 1, 2, 3, 0, 4, 1, 2, 3}));
}

TEST(ObjReader, ReadsAllFourFormsOfACorner) {
  const std::string values = square + "vt 0 0\nvt 1\nvt 1 1 0\nvn 0 0 1\n";
  const Polygons polygons = objMesh(values + "f 1 2/2 3//1 4/3/1\n").polygons;
  EXPECT_EQ(polygons.corners, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(polygons.cornerTexcoords, (std::vector<Index>{-1, 1, -1, 2}));
  EXPECT_EQ(polygons.texcoords, (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}}));
}

TEST(ObjReader, CountsNegativeIndicesBackFromTheFace) {
  EXPECT_EQ(cornersOf(square + "f -4 -3 -1\nv 2 2 2\nf -5 -4 -1\n"),
            (std::vector<Index>{0, 1, 3, 0, 1, 4}));
  EXPECT_EQ(objMesh(square + "vt 0 0\nvt 1 1\nf 1/-1 2/-2 3/-1\n").polygons.cornerTexcoords,
            (std::vector<Index>{1, 0, 1}));
}

TEST(ObjReader, LetsFacesComeBeforeTheirVertices) {
  EXPECT_EQ(cornersOf("f 1 2 4\n" + square), (std::vector<Index>{0, 1, 3}));
}

TEST(ObjReader, HasNoTextureCoordinatesWhereNoFaceUsesThem) {
  const Polygons polygons = objMesh(square + "vt 0 0\nf 1 2 3\n").polygons;
  EXPECT_TRUE(polygons.cornerTexcoords.empty());
  EXPECT_TRUE(polygons.texcoords.empty());
}

TEST(ObjReader, KeepsGroupsMaterialsAndMaterialFiles) {
  const Polygons polygons = objMesh("mtllib a.mtl b.mtl\nmtllib c.mtl a.mtl\n" + square +
                                    "f 1 2 3\ng left eye\nusemtl skin # 2\nf 1 2 3\n"
                                    "g\nf 1 2 4\nusemtl iris\ng left eye\nf 1 2 3\n")
                                .polygons;
  EXPECT_EQ(polygons.materialFiles, (std::vector<std::string>{"a.mtl", "b.mtl", "c.mtl"}));
  EXPECT_EQ(polygons.groups, (std::vector<std::string>{"left eye"}));
  EXPECT_EQ(polygons.faceGroup, (std::vector<Index>{-1, 0, -1, 0}));
  EXPECT_EQ(polygons.materials, (std::vector<std::string>{"skin # 2", "iris"}));
  EXPECT_EQ(polygons.faceMaterial, (std::vector<Index>{-1, 0, 0, 1}));
}

TEST(ObjReader, TakesObjectsForGroupsWhereThereAreNoGroups) {
  const Polygons polygons =
      objMesh(square + "o head\nf 1 2 3\ng brow\nf 1 2 3\no rest\nf 1 2 3\n").polygons;
  EXPECT_EQ(polygons.groups, (std::vector<std::string>{"head", "brow"}));
  EXPECT_EQ(polygons.faceGroup, (std::vector<Index>{0, 1, 1}));
}

TEST(ObjReader, ReadsEveryKindOfLineBreak) {
  const std::vector<Index> expected{0, 1, 2, 3};
  EXPECT_EQ(cornersOf("v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n"), expected);
  EXPECT_EQ(cornersOf("v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4"), expected);
}

TEST(ObjReader, JoinsLinesAfterABackslash) {
  EXPECT_EQ(cornersOf(square + "f 1 \\\n 2 3\\\r\n4\n"), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(cornersOf("# from C:\\\n" + square + "f 1 2 3\n"), (std::vector<Index>{0, 1, 2}))
      << "a comment ends with its line";
}

TEST(ObjReader, EndsAStatementWithTheCommentBehindIt) {
  EXPECT_EQ(cornersOf("v 0 0 0\nv 1 0 0 # from C:\\\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").size(), 4u);
  EXPECT_EQ(cornersOf(square + "f 1 \\\n 2 3 # D:\\heads\\\nf 1 3 4\n"),
            (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(objMesh(square + "g left # \\\nbrow\nf 1 2 3\n").polygons.groups,
            (std::vector<std::string>{"left #  brow"}))
      << "a name may have a '#'";
}

TEST(ObjReader, PassesOverWhatAMeshDoesNotNeed) {
  EXPECT_EQ(cornersOf("\xEF\xBB\xBF# made by hand\n\n \t\n" + square +
                      "vn nan 0 0\nvp 1\ns off\nl 1 2\np 1\ncurv 0 1 1 2\nwhatever 1\n"
                      "  f\t1 2 3  # a face\n"),
            (std::vector<Index>{0, 1, 2}));
}

TEST(ObjReader, TakesWeightsAndColoursAfterAPosition) {
  const PolygonMesh mesh =
      objMesh("v 1 2 3 1\nv 4 5 6 .5 .5 .5\nv 7 8 9 1 1 1 1 # grey\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(ObjReader, KeepsFacesThatRepeatAVertex) {
  EXPECT_EQ(cornersOf(square + "f 1 2 1\n"), (std::vector<Index>{0, 1, 0}));
}

struct BadObj {
  std::string name, text;
  std::vector<std::string> says;
};

void PrintTo(const BadObj& bad, std::ostream* out) { *out << bad.name; }

class ObjErrors : public ::testing::TestWithParam<BadObj> {};

TEST_P(ObjErrors, NameTheFileTheLineAndWhatIsWrong) {
  const auto mesh = parseObj(GetParam().text, "heads/a.obj");
  EXPECT_TRUE(failsWith(mesh, {"heads/a.obj"}));
  for (const std::string& part : GetParam().says) EXPECT_TRUE(failsWith(mesh, {part}));
}

INSTANTIATE_TEST_SUITE_P(
    All, ObjErrors,
    ::testing::Values(
        BadObj{"EmptyFile", "", {"is empty"}}, BadObj{"BlankFile", " \n\n", {"is empty"}},
        BadObj{"NoVertices", "f 1 2 3\n", {"has no vertices"}},
        BadObj{"Utf16", std::string("\xff\xfev\0 \0", 6), {"in UTF-16; save it in UTF-8"}},
        BadObj{"NotAnObj", std::string("\x89PNG\r\n\0\1", 8), {"has no vertices"}},
        BadObj{"NoFaces", square, {"has no faces"}},
        BadObj{"VertexCutShort", "v 0 0 0\nv 1 2", {"line 2", "2 of the 3", "may be cut short"}},
        BadObj{"VertexTooShort", "v 0 0\nv 1 2 3\n", {"line 1", "2 of the 3", "correct it"}},
        BadObj{"FaceCutShort", square + "f 1/", {"line 5", "1 of the 3", "may be cut short"}},
        BadObj{"FaceTooSmall", square + "f 1 2 # 3\nf 1 2 3\n", {"line 5", "2 of the 3 corners"}},
        BadObj{"NoNumber", "v 0 0 zero\n", {"line 1", "'zero' is not a number"}},
        BadObj{"HalfANumber", "v 0 1.5x 0\n", {"line 1", "'1.5x' is not a number"}},
        BadObj{"DecimalComma", "v 0,5 0 0\n", {"line 1", "'0,5'"}},
        BadObj{"TwoSigns", "v +-1 0 0\n", {"line 1", "'+-1'"}},
        BadObj{"GluedLines", "v 0 0 0 v 1 1 1\n", {"line 1", "'v' is not a number"}},
        BadObj{"Nan", "v 0 nan 0\n", {"line 1", "'nan' is not finite"}},
        BadObj{"Infinity", "v 0 0 -inf\n", {"line 1", "'-inf' is not finite"}},
        BadObj{"BeyondDouble", "v 1e999 0 0\n", {"line 1", "'1e999'", "beyond range"}},
        BadObj{"BeyondFloat", "v 1e39 0 0\n", {"line 1", "'1e39'", "too large"}},
        BadObj{"TexcoordMissing", "vt\n", {"line 1", "has no numbers"}},
        BadObj{"TexcoordNan", "vt 0 nan\n", {"line 1", "'nan'"}},
        BadObj{"VertexZero", square + "f 0 1 2\n", {"line 5", "vertex '0'"}},
        BadObj{"VertexTooFar", square + "f 1 2 3\nf 1 2 5\n", {"line 6", "vertex 5 of 4"}},
        BadObj{"VertexTooFarBack", square + "f 1 2 -5\n", {"line 5", "vertex '-5'"}},
        BadObj{"VertexBeyondIndex", square + "f 1 2 2147483648\n", {"line 5", "'2147483648'"}},
        BadObj{"VertexBeyondAll", square + "f 1 2 99999999999999999999\n", {"line 5", "'9999"}},
        BadObj{"TexcoordTooFar",
               square + "vt 0 0\nf 1/1 2/1 3/2\n",
               {"line 6", "texture coordinate 2 of 1"}},
        BadObj{"TexcoordZero",
               square + "vt 0 0\nf 1/0 2/1 3/1\n",
               {"line 6", "texture coordinate '0'"}},
        BadObj{"CornerOfLetters", square + "f 1 2 c\n", {"line 5", "'c' is not v"}},
        BadObj{"CornerTooLong", square + "f 1 2 3/1/1/1\n", {"line 5", "'3/1/1/1'"}},
        BadObj{"CornerOfSlashes", square + "f 1 2 /1\n", {"line 5", "'/1'"}},
        BadObj{"LongWord", "v 0 0 " + std::string(1000, 'x') + "\n", {"xxx...'"}},
        BadObj{"ContinuedLine", square + "f 1 \\\n2\nf 1 2 3\n", {"line 5", "2 of the 3"}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sweepface
