#include "sweepface/box.hpp"
#include "sweepface/usd.hpp"

#include "gltf/written.hpp"
#include "usd/layer.hpp"

namespace sweepface {
namespace {

using namespace testing;

const std::string kMesh = "/face/mesh", kAnimation = "/face/skeleton/animation";

Layer layerOf(const Rig& rig, const UsdOptions& options = {}) {
  const Result<std::string> text = formatUsd(rig, options);
  if (text) return Layer(*text);
  ADD_FAILURE() << text.error().message;
  return Layer("#usda 1.0\n");
}

std::vector<Vec3> pointsOf(const Layer& layer) {
  return layer.vectors(kMesh + ".point3f[] points");
}
std::vector<Vec3> normalsOf(const Layer& layer) {
  return layer.vectors(kMesh + ".normal3f[] normals");
}

/// What a blend shape adds to every point, or to every normal.
std::vector<Vec3> added(const Layer& layer, const std::string& name,
                        const std::string& what = "offsets") {
  const std::string shape = kMesh + "/" + name + ".uniform ";
  std::vector<Vec3> all(pointsOf(layer).size());
  const std::vector<double> places = layer.numbers(shape + "int[] pointIndices");
  const std::vector<Vec3> moved = layer.vectors(shape + "vector3f[] " + what);
  EXPECT_EQ(moved.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    all.at(static_cast<std::size_t>(places[k])) = moved.at(k);
  return all;
}

std::vector<Vec3> sum(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b.at(k);
  return a;
}

class EveryUsdFace : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(UsdWriter, EveryUsdFace, eachFace(), faceName);

TEST_P(EveryUsdFace, HoldsTheSurfaceInSinglePrecision) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Layer layer = layerOf(rig);
  const std::vector<Vec3> neutral = surfacePositions(rig);
  expectSingle(pointsOf(layer), neutral);
  const Box box(pointsOf(layer));
  EXPECT_EQ(layer.vectors(kMesh + ".float3[] extent"), (std::vector<Vec3>{box.low, box.high}));
  expectNear(normalsOf(layer), surfaceNormals(rig), 1e-6);
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    expectNear(sum(pointsOf(layer), added(layer, rig.targets[k].name)),
               surfacePositions(rig, oneTarget(rig, k)), 4 * largest(neutral) / (1 << 24));
}

TEST_P(EveryUsdFace, HasTheFacesOfTheSource) {
  const Rig rig = converted(GetParam().rig, 0.2);
  const Layer layer = layerOf(rig);
  const Polygons& faces = rig.source.polygons;
  std::vector<double> counts, corners(faces.corners.begin(), faces.corners.end());
  for (Index f = 0; f < faces.faceCount(); ++f) counts.push_back(faces.faceSize(f));
  EXPECT_EQ(layer.numbers(kMesh + ".int[] faceVertexCounts"), counts);
  EXPECT_EQ(layer.numbers(kMesh + ".int[] faceVertexIndices"), corners);
}

Rig grid(std::string target = "smile") {
  MeshRig meshes = withTargets(plane(6, 5), 1);
  meshes.targets[0].name = std::move(target);
  return converted(meshes, 0.05);
}

TEST(UsdWriter, TurnsNormalsWithTheShapes) {
  const Rig rig = grid();
  EXPECT_FALSE(layerOf(rig).has(kMesh + "/smile.uniform vector3f[] normalOffsets"));
  UsdOptions options;
  options.morphNormals = true;
  const Layer layer = layerOf(rig, options);
  std::vector<Vec3> turned = sum(normalsOf(layer), added(layer, "smile", "normalOffsets"));
  for (Vec3& n : turned) n = normalized(n);
  expectNear(turned, surfaceNormals(rig, oneTarget(rig, 0)), 1e-6);
}

TEST(UsdWriter, CutsEdges) {
  const Rig rig = grid();
  UsdOptions options;
  options.lod = 3;
  const Layer layer = layerOf(rig, options);
  const Tessellation fine(rig.surface, 3);
  expectSingle(pointsOf(layer), fine.positions(blend(rig, {})));
  EXPECT_EQ(layer.numbers(kMesh + ".int[] faceVertexCounts").size(), 9u * 6 * 5);
  expectNear(sum(pointsOf(layer), added(layer, "smile")),
             fine.positions(blend(rig, oneTarget(rig, 0))), 1e-5);
}

TEST(UsdWriter, KeepsToABudget) {
  Rig rig = grid();
  rig.source.loose = {{9, 9, 9}}, rig.source.gridVertex.push_back(-1);
  rig.targets[0].looseDifference = {{1, 0, 0}};
  const Density density =
      densityFor(rig.surface, blend(rig, {}), {Budget::Kind::vertices, 20}).value();
  const Tessellation few(rig.surface, density);
  UsdOptions options;
  options.grid = &few;
  const Layer layer = layerOf(rig, options);
  expectSingle(pointsOf(layer), few.positions(blend(rig, {})));
  EXPECT_EQ(layer.numbers(kMesh + ".int[] faceVertexCounts"),
            std::vector<double>(few.triangles().size(), 3));
  expectNear(sum(pointsOf(layer), added(layer, "smile")),
             few.positions(blend(rig, oneTarget(rig, 0))), 1e-5);
  options.lod = 2;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"ask for one of them"}));
  const Tessellation level(rig.surface, 2);
  options.lod = 0, options.grid = &level;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"not one of the face with a density"}));
}

TEST(UsdWriter, KeepsAShapeThatMovesNothing) {
  UsdOptions options;
  options.morphNormals = true;
  for (const double size : {0.0, 1e-9}) {  // less than single precision tells from its points
    Rig rig = grid();
    for (Vec3& v : rig.targets[0].difference) v *= size;
    const Layer layer = layerOf(rig, options);
    EXPECT_EQ(layer.value(kMesh + "/smile.uniform int[] pointIndices"), "[0]");
    EXPECT_EQ(layer.value(kMesh + "/smile.uniform vector3f[] offsets"), "[(0, 0, 0)]");
    EXPECT_EQ(layer.value(kMesh + "/smile.uniform vector3f[] normalOffsets"), "[(0, 0, 0)]");
  }
}

TEST(UsdWriter, LeavesOutFacesOfTwoCornersAndFillsInTexture) {
  Rig rig = grid();
  Polygons& faces = rig.source.polygons;
  const std::size_t corners = faces.corners.size();
  faces.cornerTexcoords.assign(corners, 0);
  faces.cornerTexcoords[1] = -1;
  faces.texcoords = {{0.25, 0.5}};
  faces.corners.insert(faces.corners.end(), {0, 1});
  faces.cornerTexcoords.insert(faces.cornerTexcoords.end(), {0, 0});
  faces.faceStart.push_back(static_cast<Index>(corners) + 2);
  const Layer layer = layerOf(rig);
  EXPECT_EQ(layer.numbers(kMesh + ".int[] faceVertexCounts").size(), 30u);
  EXPECT_EQ(layer.value(kMesh + ".texCoord2f[] primvars:st"), "[(0.25, 0.5), (0, 0)]");
  const std::vector<double> indices = layer.numbers(kMesh + ".int[] primvars:st:indices");
  ASSERT_EQ(indices.size(), corners);
  EXPECT_EQ(indices[0], 0);
  EXPECT_EQ(indices[1], 1);
}

TEST(UsdWriter, BindsMaterialsThatAreCalledLikeTargets) {
  Rig rig = grid();
  rig.source.polygons.materials = {"smile", "öl", "unused"};
  rig.source.polygons.faceMaterial.assign(30, 0);
  rig.source.polygons.faceMaterial[7] = 1;
  const std::string family = kMesh + ".uniform token subsetFamily:materialBind:familyType";
  const Layer layer = layerOf(rig);
  EXPECT_EQ(layer.type(kMesh + "/smile"), "BlendShape");
  EXPECT_EQ(layer.type(kMesh + "/smile_2"), "GeomSubset");
  EXPECT_EQ(layer.value(kMesh + "/__l.int[] indices"), "[7]");
  EXPECT_EQ(layer.value(kMesh + "/smile_2.rel material:binding"), "</face/materials/smile>");
  EXPECT_EQ(layer.type("/face/materials/__l"), "Material");
  EXPECT_EQ(layer.type("/face/materials/unused"), "");
  EXPECT_EQ(layer.value(family), R"("partition")");
  rig.source.polygons.faceMaterial[0] = -1;
  EXPECT_EQ(layerOf(rig).value(family), R"("nonOverlapping")");
}

TEST(UsdWriter, NeedsNoSkeletonForAFaceThatNeverMoves) {
  Rig rig = grid();
  rig.targets.clear();
  const Layer layer = layerOf(rig);
  EXPECT_EQ(layer.type("/face"), "Xform");
  EXPECT_EQ(layer.type("/face/skeleton"), "");
  EXPECT_FALSE(layer.has(kMesh + ".rel skel:skeleton"));
}

TEST(UsdWriter, HasATimeSampleForEachFrame) {
  const Rig rig = grid();
  const Clip clip{{"smile"}, {0.5, 0.6, 0.7, 0.725}, {0, 0.25, 1.5, -1}};
  UsdOptions options;
  options.clip = &clip, options.timeCodesPerSecond = 30, options.weights = {0.75};
  const Layer layer = layerOf(rig, options);
  EXPECT_EQ(layer.value(".startTimeCode"), "15");
  EXPECT_EQ(layer.value(".endTimeCode"), "21.75");
  EXPECT_EQ(layer.value(".timeCodesPerSecond"), "30");
  EXPECT_EQ(layer.value(".framesPerSecond"), "30");
  EXPECT_EQ(layer.value(kAnimation + ".float[] blendShapeWeights"), "[0.75]");
  using Samples = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(layer.samples(kAnimation),
            (Samples{{"15", "[0],"}, {"18", "[0.25],"}, {"21", "[1.5],"}, {"21.75", "[-1],"}}));
  EXPECT_FALSE(layerOf(rig).has(".startTimeCode"));
  EXPECT_FALSE(layerOf(rig).has(".framesPerSecond"));
}

TEST(UsdWriter, TurnsTheHeadAboutItsPivot) {
  Rig rig = grid();
  rig.targets.clear();
  const HeadTrack head{{0, 1}, {{0, 0, 0, 1}, {0.6, 0, 0, 0.8}}, {1, 2, 3}};
  UsdOptions options;
  options.head = &head;
  const Layer layer = layerOf(rig, options);
  EXPECT_EQ(layer.type("/face"), "SkelRoot");
  EXPECT_EQ(layer.samples(kAnimation).at(1),
            (std::pair<std::string, std::string>{"24", "[(0.8, 0.6, 0, 0)],"}));
  EXPECT_EQ(layer.value(kAnimation + ".float3[] translations"), "[(1, 2, 3)]");
  for (const char* transforms : {"bindTransforms", "restTransforms"})
    EXPECT_EQ(layer.value(std::string("/face/skeleton.uniform matrix4d[] ") + transforms),
              "[((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 2, 3, 1))]");
  EXPECT_EQ(layer.value(".startTimeCode"), "0");
  EXPECT_EQ(layer.value(".endTimeCode"), "24");
  EXPECT_EQ(layer.numbers(kMesh + ".float[] primvars:skel:jointWeights"),
            std::vector<double>(pointsOf(layer).size(), 1));
}

TEST(UsdWriter, TurnsTheHeadAboutWhatIsUp) {
  const HeadTrack head{{0}, {{0.1, 0.7, 0.5, 0.5}}, {}};
  UsdOptions options;
  options.head = &head, options.zUp = true;
  EXPECT_EQ(layerOf(grid(), options).samples(kAnimation).at(0).second, "[(0.5, 0.1, -0.5, 0.7)],");
}

TEST(UsdWriter, SaysHowLongAUnitIsAndWhatIsUp) {
  Rig rig = grid();
  const auto metres = [&](const UsdOptions& options = {}) {
    return layerOf(rig, options).value(".metersPerUnit");
  };
  EXPECT_EQ(metres(), "0.01");
  for (const auto& [units, length] : {std::pair{"mm", "0.001"},
                                      {"cm", "0.01"},
                                      {"dm", "0.1"},
                                      {"m", "1"},
                                      {"km", "1000"},
                                      {"in", "0.0254"},
                                      {"ft", "0.3048"},
                                      {"furlongs", "0.01"}}) {
    rig.names.units = units;
    EXPECT_EQ(metres(), length) << units;
  }
  UsdOptions options;
  options.metersPerUnit = 0.1, options.zUp = true;
  EXPECT_EQ(metres(options), "0.1");
  EXPECT_EQ(layerOf(rig, options).value(".upAxis"), R"("Z")");
  EXPECT_EQ(layerOf(rig).value(".upAxis"), R"("Y")");
  rig = converted(smallFace());
  EXPECT_EQ(metres(), "1");
}

TEST(UsdWriter, WritesTheFacesOfTheSurfaceIfTheSourceIsUnknown) {
  Rig rig = grid();
  rig.source.polygons = {};
  rig.source.quadCorners.clear();
  EXPECT_EQ(layerOf(rig).numbers(kMesh + ".int[] faceVertexCounts").size(), 30u);
  UsdOptions options;
  options.lod = 2;
  EXPECT_EQ(layerOf(rig, options).numbers(kMesh + ".int[] faceVertexCounts").size(), 120u);
}

TEST(UsdWriter, RefusesWhatUsdCannotHold) {
  Rig rig = grid();
  UsdOptions options;
  options.weights = {1, 2};
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"expression has 2 weights", "1 targets"}));
  options.weights = {1e39};
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"weight is too large"}));
  options = {};
  options.lod = -1;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"level of detail"}));
  options.lod = 60'000;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"100,000,000 faces", "lower level"}));
  options = {};
  options.timeCodesPerSecond = std::nan("");
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"Time codes a second"}));
  options = {};
  options.metersPerUnit = -1;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"Metres a unit"}));
  rig.neutral[0].x = 1e39;
  EXPECT_TRUE(failsWith(formatUsd(rig, {}), {"single precision of USD"}));
  rig = grid();
  for (Vec3& v : rig.targets[0].difference) v *= 1e300;
  EXPECT_TRUE(failsWith(formatUsd(rig, {}), {"single precision of USD"}));
  rig = grid();
  rig.targets[0].difference.clear();
  EXPECT_TRUE(failsWith(formatUsd(rig, {}), {"not decoded yet"}));
}

TEST(UsdWriter, RefusesClipsThatDoNotFit) {
  Rig rig = grid();
  const auto written = [&](const Clip& clip) {
    UsdOptions options;
    options.clip = &clip;
    return formatUsd(rig, options);
  };
  EXPECT_TRUE(failsWith(written({{"a", "b"}, {0}, {0, 0}}), {"clip has 2 weights"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {}, {}}), {"no frames"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {0, 1}, {0}}), {"not as many weights"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {1, 1}, {0, 0}}), {"do not increase"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {0, std::nan("")}, {0, 0}}), {"do not increase"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {0}, {1e39}}), {"too large"}));
  EXPECT_TRUE(failsWith(written({{"a"}, {0, 1e-9}, {0, 1}}), {"a time code apart"}));
  rig.targets.clear();
  EXPECT_TRUE(failsWith(written({{}, {0}, {}}), {"no targets to animate"}));
  const HeadTrack head{{0, 1}, {{0, 0, 0, 1}}, {}};
  UsdOptions options;
  options.head = &head;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"head's rotation"}));
  const HeadTrack soon{{0, 1e-9}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {}};
  options.head = &soon;
  EXPECT_TRUE(failsWith(formatUsd(rig, options), {"a time code apart"}));
}

}  // namespace
}  // namespace sweepface
