#include <optional>
#include <tbb/global_control.h>

#include "sweepface/codec.hpp"
#include "sweepface/edit.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Rig converted(const MeshRig& source, double tolerance) {
  ConvertOptions options;
  options.tolerance = tolerance;
  auto conversion = convert(source, options);
  EXPECT_TRUE(conversion) << conversion.error().message;
  return conversion ? std::move(conversion->rig) : Rig{};
}

Rig readBack(const Rig& rig) {
  auto back = decode(encode(rig), "it");
  EXPECT_TRUE(back) << back.error().message;
  return back ? std::move(*back) : Rig{};
}

class EveryPack : public ::testing::TestWithParam<Face> {
 protected:
  const MeshRig& source() const { return GetParam().rig; }
};
INSTANTIATE_TEST_SUITE_P(Pack, EveryPack, eachFace(), faceName);

TEST_P(EveryPack, staysNearTheFaceAndIsSmall) {
  const double size = diagonal(source().neutral);
  const Rig before = converted(source(), 0.001 * size);
  Rig rig = before;
  const auto tolerance = pack(rig, {.tolerance = 0.002 * size});
  ASSERT_TRUE(tolerance) << tolerance.error().message;
  EXPECT_EQ(*tolerance, 0.002 * size);
  EXPECT_EQ(rig.tolerance, 0.001 * size + 0.002 * size);
  const Rig read = readBack(rig);
  EXPECT_LE(furthestVertex(read, before).distance, 0.002 * size);
  EXPECT_LE(furthestVertex(read, source()).distance, rig.tolerance);
  EXPECT_LT(encode(rig).size(), encode(before).size() / 4);
  EXPECT_EQ(encode(read), encode(rig));
}

/// Files need not store where source faces lie on the surface; without this, folds are not sought.
TEST(Pack, needsNotKnowTheFacesOfTheSource) {
  const MeshRig source = withTargets(torus());
  Rig rig = converted(source, 0.01);
  rig.source.quadCorners.clear();
  const Rig before = rig;
  EXPECT_EQ(countFolds(rig, source), std::vector<Index>(1 + source.targets.size(), 0));
  ASSERT_TRUE(pack(rig, {.tolerance = 0.02}));
  EXPECT_LE(furthestVertex(readBack(rig), before).distance, 0.02);
}

TEST(Pack, meshesAreTheSourceAsTheRigHasIt) {
  const MeshRig source = withTargets(torus());
  const Rig rig = converted(source, 0.01);
  const MeshRig meshes = meshesOf(rig);
  EXPECT_EQ(meshes.neutral.polygons.corners, source.neutral.polygons.corners);
  ASSERT_EQ(meshes.targets.size(), source.targets.size());
  for (Index pose = 0; pose <= static_cast<Index>(source.targets.size()); ++pose)
    for (std::size_t v = 0; v < source.neutral.positions.size(); ++v)
      EXPECT_LE(norm(meshes.positionsOf(pose)[v] - source.positionsOf(pose)[v]), 0.01);
  EXPECT_EQ(meshes.targets[0].name, source.targets[0].name);
  EXPECT_EQ(furthestVertex(rig, meshes).distance, 0);
  EXPECT_EQ(furthestVertex(rig, rig).distance, 0);
}

/// Two sheets that touch at a vertex, which has a place on each of them; an edit separates these.
TEST(Pack, keepsPlacesOfOneVertexApart) {
  MeshRig bow{plane(3, 3), {}};
  PolygonMesh other = bow.neutral;
  const auto count = static_cast<Index>(bow.neutral.positions.size());
  const Vec3 way = bow.neutral.positions.back() - bow.neutral.positions.front();
  for (Vec3& p : other.positions) bow.neutral.positions.push_back(p + way);
  for (const Index corner : other.polygons.corners)  // its first vertex is our last
    bow.neutral.polygons.corners.push_back(corner == 0 ? count - 1 : count + corner);
  const Index corners = bow.neutral.polygons.faceStart.back();
  for (std::size_t f = 1; f < other.polygons.faceStart.size(); ++f)
    bow.neutral.polygons.faceStart.push_back(corners + other.polygons.faceStart[f]);
  const Rig fitted = converted(bow, 0.05);
  int edits = 0;
  for (Index node = 0; node < static_cast<Index>(fitted.surface.wireframe().nodes.size()); ++node) {
    Rig rig = fitted;
    if (!moveNodes(rig, std::vector{NodeMove{node, {0, 0, 0.5}}})) continue;
    ++edits;
    const Rig before = rig;
    const auto packed = pack(rig, {.tolerance = 0.001});
    ASSERT_TRUE(packed) << packed.error().message;
    EXPECT_LE(furthestVertex(readBack(rig), before).distance, 0.001);
  }
  EXPECT_GE(edits, 7);
}

TEST(Pack, keepsEdits) {
  Rig rig = converted(withTargets(plane()), 0.01);
  Index node = 0;  // the first that may be moved
  while (!moveNodes(rig, std::vector{NodeMove{node, {0, 0, 1}}})) ++node;
  const MeshRig edited = meshesOf(rig);
  ASSERT_TRUE(pack(rig, {.tolerance = 0.02}));
  EXPECT_LE(furthestVertex(readBack(rig), edited).distance, 0.02);
}

TEST(Pack, goesByTheToleranceAndTheBitsOfTheFaceUnlessTold) {
  Rig rig = converted(withTargets(plane()), 0.03);
  EXPECT_EQ(pack(rig), 0.03);
  EXPECT_EQ(rig.packing.textureBits, 14);
  ASSERT_TRUE(pack(rig, {.tolerance = 0.01, .textureBits = 9}));
  EXPECT_EQ(rig.packing.textureBits, 9);
  ASSERT_TRUE(pack(rig, {.tolerance = 0.01}));
  EXPECT_EQ(rig.packing.textureBits, 9);
  EXPECT_EQ(pack(rig), 0.01);  // not the sum of all tolerances so far
  rig.tolerance = 0;
  rig.packing = {};
  const double size = diagonal(meshesOf(rig).neutral);
  EXPECT_EQ(pack(rig), 0.0002 * size);
}

TEST(Pack, isTheSameOnOneThreadAsOnMany) {
  const Rig before = converted(withTargets(torus()), 0.01);
  std::string bytes[2];
  for (const int threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Rig rig = before;
    ASSERT_TRUE(pack(rig));
    bytes[threads > 1] = encode(rig);
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Pack, tellsHowItGetsOnWithTheNeutralAndStopsThere) {
  Rig rig = converted(withTargets(torus()), 0.01);
  std::vector<double> heard;
  std::atomic<bool> cancel = false;
  const PackOptions options{.progress =
                                [&](auto, double done) {
                                  if (cancel) return;
                                  heard.push_back(done);
                                  cancel = done > 0.03;
                                },
                            .cancel = &cancel};
  ASSERT_FALSE(pack(rig, options));
  EXPECT_GT(heard.size(), 5u);
  EXPECT_LT(heard.back(), 0.1) << "the neutral's share";
  EXPECT_TRUE(std::ranges::is_sorted(heard)) << ::testing::PrintToString(heard);
}

TEST(Pack, leavesTheFaceAsItWasWhereItFails) {
  Rig rig = converted(withTargets(torus()), 0.01);
  const std::string before = encode(rig);
  const auto refusal = [&](const PackOptions& options) {
    const auto packed = pack(rig, options);
    EXPECT_EQ(encode(rig), before);
    return packed ? "" : packed.error().message;
  };
  std::atomic<bool> cancel = false;
  EXPECT_EQ(refusal({.progress = [&](auto, double done) { cancel = done > 0; }, .cancel = &cancel}),
            "packing was interrupted");
  EXPECT_EQ(refusal({.textureBits = 17}), "packed texture coordinates have 8 to 16 bits, not 17");
  EXPECT_EQ(refusal({.textureBits = 7}), "packed texture coordinates have 8 to 16 bits, not 7");
  EXPECT_TRUE(refusal({.tolerance = 1e9}).contains("larger than the mesh"));
  EXPECT_TRUE(refusal({.tolerance = 1e-12}).contains("finer than a file's numbers"));
}

TEST(Pack, comparesATargetWithTheImageOfTheOtherSide) {
  MeshRig face{grid(12, 5, [](double i, double j) { return Vec3{i - 6, j + i * (12 - i) / 9, 0}; }),
               {}};
  for (const auto& [name, side] : {std::pair("smile_L", 1.0), {"smile_R", -1.0}}) {
    MeshTarget& smile = face.targets.emplace_back(name, face.neutral.positions);
    for (Vec3& p : smile.positions)
      p.z += std::exp(-0.3 * (p.x - 3 * side) * (p.x - 3 * side) - 0.2 * p.y * p.y);
  }
  Rig rig = converted(face, 0.001);
  ASSERT_TRUE(pack(rig, {.tolerance = 0.002}));
  ASSERT_EQ(rig.packing.poses.size(), 3u);
  EXPECT_EQ(rig.packing.poses[1].image, -1);
  EXPECT_EQ(rig.packing.poses[2].image, 1);
}

TEST(Pack, needsTheTargets) {
  Rig whole = converted(withTargets(plane()), 0.01);
  ASSERT_TRUE(pack(whole));
  auto neutral = decodeNeutral(encode(whole), "it");
  ASSERT_TRUE(neutral) << neutral.error().message;
  const auto packed = pack(neutral->rig);
  ASSERT_FALSE(packed);
  EXPECT_TRUE(packed.error().message.contains("not decoded yet"));
}

}  // namespace
}  // namespace sweepface
