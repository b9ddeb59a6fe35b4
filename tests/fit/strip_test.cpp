#include "sweepface/strip.hpp"

#include <gtest/gtest.h>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class EveryStrip : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Strip, EveryStrip, eachFace(), faceName);

/// The corner positions of all faces, independent of the order of faces and of each face's first
/// corner.
std::vector<std::vector<std::array<double, 3>>> facesInSpace(const Rig& rig) {
  const Tessellation grid(rig.surface, 1);
  const Weights still(rig.targets.size(), 0.0);
  const auto positions = sourcePositions(rig, grid, blend(rig, still), still);
  std::vector<std::vector<std::array<double, 3>>> faces;
  const Polygons& p = rig.source.polygons;
  for (Index f = 0; f < p.faceCount(); ++f) {
    std::vector<std::array<double, 3>> face;
    for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) {
      const Vec3& x = positions[p.corners[c]];
      face.push_back({x.x, x.y, x.z});
    }
    std::ranges::rotate(face, std::ranges::min_element(face));
    faces.push_back(face);
  }
  std::ranges::sort(faces);
  return faces;
}

TEST_P(EveryStrip, WithoutItsOrderTheFaceIsTheSameAndItsPolygonsCostHardlyAnything) {
  ConvertOptions options;
  options.pack = true;
  const Rig rig = convert(GetParam().rig, options).value().rig;
  Rig bare = rig;
  ASSERT_TRUE(strip(bare, {.order = true}));
  const Rig back = decode(encode(bare), "face").value();
  EXPECT_FALSE(back.source.ownOrder);
  EXPECT_TRUE(rig.source.ownOrder);
  EXPECT_EQ(facesInSpace(back), facesInSpace(rig));
  EXPECT_EQ(encode(back), encode(bare));
  std::size_t order = 0, polygons = 0;
  const auto parts = fileParts(encode(bare), "face").value();
  for (const FilePart& part : parts)
    (part.name == "polygons" ? polygons : order) += part.name == "source order" ? part.bytes
                                                    : part.name == "polygons"   ? part.bytes
                                                                                : 0;
  EXPECT_EQ(order, 0u);
  EXPECT_LE(polygons, 40 + static_cast<std::size_t>(rig.source.polygons.faceCount()) / 16);
}

TEST(Strip, LeavesOutWhatItIsAskedTo) {
  Rig rig = convert(withTargets(plane())).value().rig;
  Polygons& faces = rig.source.polygons;
  faces.texcoords = {{0, 0}};
  faces.cornerTexcoords.assign(faces.corners.size(), 0);
  faces.materials = {"skin"};
  faces.faceMaterial.assign(faces.faceCount(), 0);
  faces.materialFiles = {"skin.mtl"};
  rig.scene = "scene";
  Rig bare = rig;
  ASSERT_TRUE(strip(bare, parseStrip("uv,groups,scene").value()));
  EXPECT_TRUE(bare.source.polygons.texcoords.empty());
  EXPECT_TRUE(bare.source.polygons.cornerTexcoords.empty());
  EXPECT_TRUE(bare.source.polygons.materials.empty());
  EXPECT_TRUE(bare.source.polygons.materialFiles.empty());
  EXPECT_TRUE(bare.scene.empty());
  EXPECT_EQ(bare.source.gridVertex, rig.source.gridVertex);
}

TEST(Strip, TheSceneGoesWithTheOrderThatItCountsOn) {
  Rig rig = convert(withTargets(plane())).value().rig;
  rig.scene = "scene";
  ASSERT_TRUE(strip(rig, {.uv = true, .groups = true}));
  EXPECT_EQ(rig.scene, "scene");
  ASSERT_TRUE(strip(rig, {.order = true}));
  EXPECT_TRUE(rig.scene.empty());
}

TEST(Strip, KeepsMaterialsAndTextureCoordinatesWithTheirFaces) {
  Rig rig = convert(withTargets(plane())).value().rig;
  Polygons& faces = rig.source.polygons;
  faces.materials = {"a", "b"};
  for (Index f = 0; f < faces.faceCount(); ++f) faces.faceMaterial.push_back(f % 2);
  for (std::size_t c = 0; c < faces.corners.size(); ++c) {
    faces.texcoords.push_back({static_cast<double>(rig.source.gridVertex[faces.corners[c]]), 0});
    faces.cornerTexcoords.push_back(static_cast<Index>(c));
  }
  Rig bare = rig;
  ASSERT_TRUE(strip(bare, {.order = true}));
  const Polygons& after = bare.source.polygons;
  for (std::size_t c = 0; c < after.corners.size(); ++c)
    EXPECT_EQ(after.texcoords[after.cornerTexcoords[c]].x, after.corners[c]);
  EXPECT_EQ(std::ranges::count(after.faceMaterial, 1), std::ranges::count(faces.faceMaterial, 1));
}

TEST(Strip, TextureCoordinatesComeInTheOrderOfTheirCorners) {
  Rig rig = convert(withTargets(plane())).value().rig;
  Polygons& faces = rig.source.polygons;
  const auto count = static_cast<Index>(faces.corners.size());
  for (Index c = 0; c < count; ++c) faces.cornerTexcoords.push_back(7 * (count - c));
  for (Index t = 0; t <= 7 * count; ++t) faces.texcoords.push_back({1.0 * t, 0});
  ASSERT_TRUE(strip(rig, {.order = true}));
  EXPECT_EQ(faces.texcoords.size(), faces.corners.size()) << "unused ones are left out";
  for (Index c = 0; c < count; ++c) EXPECT_EQ(faces.cornerTexcoords[c], c);
}

TEST(Strip, FacesWithoutASurfaceGoWithTheOrder) {
  MeshRig source = withTargets(plane(2, 2), 1);
  source.neutral.positions.push_back({5, 5, 5});  // used by no proper face
  source.targets[0].positions.push_back({5, 6, 5});
  PolygonMesh& mesh = source.neutral;
  mesh.polygons = {};
  addFace(mesh, {9, 9, 9});
  for (const Loop& face : loopsOf(plane(2, 2).polygons)) addFace(mesh, face);
  mesh.polygons.materials = mesh.polygons.groups = {"a", "b"};
  mesh.polygons.faceMaterial = mesh.polygons.faceGroup = {0, 1, 1, 1, 1};
  Rig rig = convert(source).value().rig;
  EXPECT_GT(bareBytes(rig), 0u);
  ASSERT_TRUE(strip(rig, {.order = true}));
  EXPECT_EQ(rig.source.polygons.faceMaterial, (std::vector<Index>{1, 1, 1, 1}));
  EXPECT_EQ(rig.source.polygons.faceGroup, (std::vector<Index>{1, 1, 1, 1}));
  EXPECT_TRUE(rig.targets[0].looseDifference.empty());
  const Rig back = decode(encode(rig), "face").value();
  EXPECT_EQ(back.source.polygons.faceCount(), 4);
  EXPECT_EQ(back.source.gridVertex.size(), 9u);
}

TEST(Strip, RefusesFacesThatAreOnlyPartlyOnTheSurface) {
  Rig rig = convert(withTargets(plane())).value().rig;
  rig.source.quadCorners.clear();
  rig.source.gridVertex[rig.source.polygons.corners[0]] = -1;
  const auto stripped = strip(rig, {.order = true});
  ASSERT_FALSE(stripped);
  EXPECT_EQ(stripped.error().message, "a face has a corner that is on no patch; keep the order");
}

// As left behind by dissolving edges: the face runs out to a vertex that no other face uses, and
// back.
TEST(Strip, TipsOfSpikesGoWithTheOrder) {
  MeshRig source;
  source.neutral.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {3, 0, 0}};
  addFace(source.neutral, {0, 1, 4, 1, 2, 3});
  const auto conversion = convert(source);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_EQ(conversion->warnings, std::vector<std::string>());
  Rig rig = conversion->rig;
  EXPECT_GT(bareBytes(rig), 0u);
  ASSERT_TRUE(strip(rig, {.order = true}));
  EXPECT_EQ(rig.source.polygons.corners.size(), 4u);
  EXPECT_EQ(decode(encode(rig), "face").value().source.gridVertex.size(), 4u);
}

TEST(Strip, NamesOnlyPartsThatThereAre) {
  EXPECT_TRUE(parseStrip("order,uv,groups,scene"));
  EXPECT_TRUE(parseStrip("order, uv")->uv);
  for (const char* text : {"hair", "uv,", "uv order", "UV"}) {
    const auto parts = parseStrip(text);
    ASSERT_FALSE(parts) << text;
    EXPECT_NE(parts.error().message.find("order, uv, groups and scene"), std::string::npos);
  }
}

}  // namespace
}  // namespace sweepface
