#include <gtest/gtest.h>

#include "sweepface/io.hpp"

namespace sweepface {
namespace {

Polygons oneTriangle() {
  Polygons polygons;
  polygons.faceStart = {0, 3};
  polygons.corners = {0, 1, 2};
  polygons.faceGroup = polygons.faceMaterial = {-1};
  return polygons;
}

const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0.1, -2.5, 1e-9}};

TEST(ObjWriter, WritesPositionsAndFaces) {
  EXPECT_EQ(formatObj({positions, {}, oneTriangle()}),
            "v 0 0 0\nv 1 0 0\nv 0.1 -2.5 1e-09\nf 1 2 3\n");
}

TEST(ObjWriter, WritesNormalsByVertex) {
  const std::vector<Vec3> normals(3, {0, 0, 1});
  const std::string text = formatObj({positions, normals, oneTriangle()});
  EXPECT_NE(text.find("vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//3\n"), std::string::npos);
}

TEST(ObjWriter, WritesTextureCoordinatesWhereACornerHasThem) {
  Polygons polygons = oneTriangle();
  polygons.texcoords = {{0, 0}, {0.5, 1}};
  polygons.cornerTexcoords = {1, -1, 0};
  EXPECT_NE(formatObj({positions, {}, polygons}).find("vt 0 0\nvt 0.5 1\nf 1/2 2 3/1\n"),
            std::string::npos);
  EXPECT_NE(formatObj({positions, positions, polygons}).find("f 1/2/1 2//2 3/1/3\n"),
            std::string::npos);
}

TEST(ObjWriter, SwitchesGroupsAndMaterialsWhereTheyChange) {
  Polygons polygons;
  polygons.faceStart = {0, 3, 6, 9};
  polygons.corners = {0, 1, 2, 0, 1, 2, 0, 1, 2};
  polygons.groups = {"left eye"};
  polygons.materials = {"skin", "iris"};
  polygons.materialFiles = {"a.mtl", "b.mtl"};
  polygons.faceGroup = {0, 0, -1};
  polygons.faceMaterial = {-1, 1, 1};
  EXPECT_EQ(formatObj({{}, {}, polygons}),
            "mtllib a.mtl b.mtl\ng left eye\nf 1 2 3\nusemtl iris\nf 1 2 3\ng\nf 1 2 3\n");
}

TEST(ObjWriter, LetsNoNameBreakOutOfItsLine) {
  Polygons polygons = oneTriangle();
  polygons.groups = {"a\nv 1 2 3\\"};
  polygons.faceGroup = {0};
  EXPECT_NE(formatObj({positions, {}, polygons}).find("\ng a_v 1 2 3_\nf 1 2 3\n"),
            std::string::npos);
}

TEST(ObjWriter, WritesNumbersThatReadBackExactly) {
  const std::vector<Vec3> exact{{1.0 / 3, -0.0, 5e-324}, {3.4e38, 0.1f, 123456789.123}, {1, 2, 3}};
  const auto mesh = parseObj(formatObj({exact, {}, oneTriangle()}), "a.obj");
  ASSERT_TRUE(mesh.has_value()) << mesh.error().message;
  EXPECT_EQ(mesh->positions, exact);
}

}  // namespace
}  // namespace sweepface
