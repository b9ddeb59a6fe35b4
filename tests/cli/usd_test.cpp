#include "cli/tool.hpp"
#include "gltf/written.hpp"
#include "usd/layer.hpp"

namespace sweepface {
namespace {

using namespace testing;

class ToolUsd : public Tool {
 protected:
  Layer layer(std::string_view name) { return Layer(contents(folder / name)); }
  std::vector<Vec3> points(std::string_view name) {
    return layer(name).vectors("/face/mesh.point3f[] points");
  }
};

const std::string kSamples = "/face/skeleton/animation";

TEST_F(ToolUsd, HasAllTargets) {
  convertRig();
  const Outcome r = run("export face.sweep -o face.usda --weights smile=0.5");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out,
            fmt::format("face.usda: 2 targets, {} bytes\n", contents(folder / "face.usda").size()));
  EXPECT_EQ(layer("face.usda").value("/face/mesh.uniform token[] skel:blendShapes"),
            R"(["jawOpen", "smile"])");
  EXPECT_EQ(layer("face.usda").value(kSamples + ".float[] blendShapeWeights"), "[0, 0.5]");
  ASSERT_EQ(run("export face.sweep -o out.obj").code, 0);
  expectNear(points("face.usda"), mesh("out.obj").positions, 1e-6);
}

TEST_F(ToolUsd, TakesTheOptionsOfExport) {
  convertRig();
  const Outcome r = run("export face.sweep -o A.USD -q --lod 2 --morph-normals --z-up");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "");
  ASSERT_EQ(run("export face.sweep -o out.obj --lod 2").code, 0);
  expectNear(points("A.USD"), mesh("out.obj").positions, 1e-6);
  EXPECT_TRUE(layer("A.USD").has("/face/mesh/smile.uniform vector3f[] normalOffsets"));
  EXPECT_EQ(layer("A.USD").value(".upAxis"), R"("Z")");
}

TEST_F(ToolUsd, KeepsToABudget) {
  convertRig();
  const Outcome r = run("export face.sweep -o far.usda --vertices 50");
  ASSERT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(run("export face.sweep -o far.obj --vertices 50").code, 0);
  const std::vector<Vec3> expected = mesh("far.obj").positions;
  EXPECT_LE(expected.size(), 50u);
  expectNear(points("far.usda"), expected, 1e-6);
  EXPECT_EQ(r.out, fmt::format("far.usda: 2 targets, {} vertices, {} bytes\n", expected.size(),
                               contents(folder / "far.usda").size()));
  ASSERT_EQ(run("export face.sweep -o far.glb --vertices 50").code, 0);
  const Written glb(contents(folder / "far.glb"));
  std::vector<Vec3> found = glb.vectors(glb.attribute("POSITION"));
  found.resize(expected.size());
  expectNear(found, expected, 1e-6);
}

TEST_F(ToolUsd, HasFramesForTimeCodes) {
  convertRig();
  const std::string animate = "animate face.sweep --to smile=1 --law linear --seconds 2 -o m.usda";
  Outcome r = run(animate);
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "m.usda: 61 frames of 2 s, linear\n");
  EXPECT_EQ(layer("m.usda").value(".timeCodesPerSecond"), "30");
  EXPECT_EQ(layer("m.usda").samples(kSamples).at(30).second, "[0, 0.5],");
  ASSERT_EQ(run(animate + " --fps 24").code, 0);
  EXPECT_EQ(layer("m.usda").value(".timeCodesPerSecond"), "24");
  EXPECT_EQ(layer("m.usda").samples(kSamples).back().first, "48");
  ASSERT_EQ(run(animate + " --frames 5").code, 0);
  EXPECT_EQ(layer("m.usda").value(".timeCodesPerSecond"), "2");
  EXPECT_EQ(layer("m.usda").samples(kSamples).at(1).first, "1");
}

TEST_F(ToolUsd, RefusesOptionsThatDoNotGoTogether) {
  convertRig();
  folder.file("out.usda", "old");
  EXPECT_TRUE(fails("export face.sweep -o out.usda --quantize", "is for .glb files"));
  EXPECT_TRUE(fails("export face.sweep -o out.usda --vertices 2", "vertices"));
  EXPECT_TRUE(fails("export face.sweep -o out.usda --combine", "A .usda holds all targets"));
  EXPECT_TRUE(fails("export face.sweep -o out.usdc", "must end in"));
  EXPECT_TRUE(fails("export face.sweep -o out.obj --z-up", "is for .glb, .usda and .usdz files"));
  EXPECT_TRUE(
      fails("export face.sweep -o all --meters-per-unit 1", "is for .glb, .usda and .usdz files"));
  EXPECT_TRUE(fails("export face.sweep -o out.usda --meters-per-unit 0", "--meters-per-unit", 2));
  const std::string animate = "animate face.sweep --to smile=1 -o out.usda ";
  EXPECT_TRUE(fails(animate + "--keys exact", "are for .glb files"));
  EXPECT_TRUE(fails(animate + "--seconds 1e-9", "a time code apart"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o out.usdc", ".usda, .usdz or .csv"));
  EXPECT_TRUE(fails(animate + "--head on", "has no angles of the head"));
  EXPECT_TRUE(fails("animate still.sweep -o out.usda", "Say where to go with --to"));
  EXPECT_EQ(contents(folder / "out.usda"), "old");
}

}  // namespace
}  // namespace sweepface
