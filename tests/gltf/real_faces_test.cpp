#include <algorithm>
#include <iterator>
#include <set>

#include "faces.hpp"
#include "gltf/bound_scene.hpp"
#include "gltf/glb.hpp"
#include "gltf/triangles.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
namespace fs = std::filesystem;

struct Both {
  MeshRig fromGlb, fromObj;
};

/// The same face from a GLB and from OBJ files, or a failure.
Both readBoth(const char* glb, const char* folder) {
  const fs::path faces = fs::path(realFaces()) / "ictface";
  const std::vector<fs::path> targets{faces / folder / "expressions"};
  auto source = readSource(faces / "glb" / glb, {});
  auto rig = readRig(faces / folder / "neutral.obj", targets);
  EXPECT_TRUE(source) << source.error().message;
  EXPECT_TRUE(rig) << rig.error().message;
  if (!source || !rig) return {};
  return {std::move(source->rig), std::move(*rig)};
}

double largestDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.size(); ++v) worst = std::max(worst, norm(a[v] - b[v]));
  return worst;
}

/// The vertices of both are in the same order.
void expectSameFace(const Both& both, std::size_t vertices) {
  // Two roundings of 20 units to single precision; small differences were also left out.
  constexpr double within = 3e-6;
  const auto& neutral = both.fromGlb.neutral.positions;
  ASSERT_EQ(neutral.size(), vertices);
  ASSERT_EQ(both.fromObj.neutral.positions.size(), vertices);
  EXPECT_LE(largestDistance(neutral, both.fromObj.neutral.positions), within);
  ASSERT_EQ(both.fromGlb.targets.size(), 57u);
  std::set<std::string> names;
  for (const MeshTarget& target : both.fromGlb.targets) {
    names.insert(target.name);
    const auto same = std::ranges::find(both.fromObj.targets, target.name, &MeshTarget::name);
    ASSERT_NE(same, both.fromObj.targets.end()) << target.name;
    EXPECT_LE(largestDistance(target.positions, same->positions), within) << target.name;
  }
  EXPECT_EQ(names.size(), 57u);
}

/// The quads of a mesh, as sorted vertices.
std::set<std::vector<Index>> quadsOf(const MeshRig& rig) {
  std::set<std::vector<Index>> quads;
  for (std::vector<Index> face : loopsOf(rig.neutral.polygons)) {
    std::ranges::sort(face);
    if (face.size() == 4) quads.insert(face);
  }
  return quads;
}

TEST(RealFace, AHeadOfDenseTargetsIsThatOfItsObjFiles) {
  SKIP_WITHOUT_REAL_FACES();
  const Both both = readBoth("head.glb", "head");
  expectSameFace(both, 11248);
  EXPECT_EQ(quadsOf(both.fromGlb), quadsOf(both.fromObj));
  EXPECT_EQ(both.fromGlb.neutral.polygons.faceCount(), 11144);
}

TEST(RealFace, AWholeFaceOfSparseTargetsIsThatOfItsObjFiles) {
  SKIP_WITHOUT_REAL_FACES();
  const Both both = readBoth("full_sparse.glb", ".");
  expectSameFace(both, 26719);
  // All quads but three that are folded too far; some of the 548 triangles become quads, too.
  const auto quads = quadsOf(both.fromObj), found = quadsOf(both.fromGlb);
  std::vector<std::vector<Index>> missing;
  std::ranges::set_difference(quads, found, std::back_inserter(missing));
  EXPECT_LE(missing.size(), 3u);
  EXPECT_LE(found.size(), quads.size() + 548 / 2);
}

/// The triangles of a document's parts in ascending order, each starting at its smallest vertex.
std::vector<std::vector<Triangle>> trianglesIn(const gltf::Document& document,
                                               const gltf::Parts& parts) {
  std::vector<std::vector<Triangle>> all;
  for (const gltf::Part& part : parts.parts) {
    auto& triangles = all.emplace_back(gltf::trianglesOf(document, parts, part)->triangles);
    for (Triangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
    std::ranges::sort(triangles);
  }
  return all;
}

TEST(RealFace, LeavesItsSceneHardlyAnythingAndGetsItsTrianglesBack) {
  SKIP_WITHOUT_REAL_FACES();
  for (const char* name : {"head.glb", "full_sparse.glb"}) {
    const fs::path path = fs::path(realFaces()) / "ictface" / "glb" / name;
    auto source = readSource(path, {});
    ASSERT_TRUE(source) << source.error().message;
    EXPECT_LT(source->scene.size(), 1000u);
    Rig rig;
    for (const MeshTarget& target : source->rig.targets) rig.targets.emplace_back(target.name);
    rig.scene = source->scene;
    rig.source.gridVertex.resize(source->rig.neutral.positions.size());
    rig.source.polygons = source->rig.neutral.polygons;
    const auto scene = gltf::sceneOf(rig);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto before = gltf::parseDocument(readFile(path).value(), {});
    EXPECT_EQ(trianglesIn(scene->document, scene->parts),
              trianglesIn(*before, *gltf::findParts(*before)));
  }
}

}  // namespace
}  // namespace sweepface
