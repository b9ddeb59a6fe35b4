#include "sweepface/trajectory.hpp"

#include "cli/tool.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// The small face with a hat on.
Glb headAndHat() {
  Glb glb = smallFace();
  glb.json["nodes"][0]["children"] = {1};
  glb.add("nodes", {{"name", "hat"}, {"translation", {0, 1, 0}}});
  return glb;
}

class ToolGlb : public Tool {
 protected:
  Written glb(std::string_view name) { return Written(contents(folder / name)); }
  std::vector<Vec3> exported(const std::string& weights) {
    EXPECT_EQ(run("export face.sweep -o out.obj --weights '" + weights + "'").code, 0);
    return mesh("out.obj").positions;
  }
};

TEST_F(ToolGlb, HasAllTargets) {
  convertRig();
  const Outcome r = run("export face.sweep -o face.glb");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out,
            fmt::format("face.glb: 2 targets, {} bytes\n", contents(folder / "face.glb").size()));
  const Written file = glb("face.glb");
  EXPECT_EQ(file.json["meshes"][0]["extras"]["targetNames"], Json({"jawOpen", "smile"}));
  EXPECT_EQ(file.json["meshes"][0]["primitives"].size(), 2u);
  const std::vector<Vec3> neutral = file.vectors(file.attribute("POSITION"));
  expectNear(neutral, exported(""), 1e-6);
  std::vector<Vec3> smile = file.vectors(file.morph(1));
  for (std::size_t v = 0; v < smile.size(); ++v) smile[v] += neutral[v];
  expectNear(smile, exported("smile=1"), 1e-6);
}

TEST_F(ToolGlb, TakesTheOptionsOfExport) {
  convertRig();
  ASSERT_EQ(run("export face.sweep -o a.GLB --quiet --weights smile=0.5 --lod 3 --quantize "
                "--morph-normals")
                .code,
            0);
  const Written file = glb("a.GLB");
  EXPECT_EQ(file.json["meshes"][0]["weights"], Json({0.0, 0.5}));
  EXPECT_EQ(file.indices(0, 0).size() + file.indices(0, 1).size(), 3u * 2 * 30 * 9);
  EXPECT_TRUE(file.primitive()["targets"][0].contains("NORMAL"));
  EXPECT_EQ(file.json["extensionsUsed"], Json::array({"KHR_mesh_quantization"}));
  ASSERT_EQ(run("export face.sweep -o b.glb --source-order").code, 0);
  ASSERT_EQ(run("export face.sweep -o c.glb").code, 0);
  EXPECT_EQ(contents(folder / "b.glb"), contents(folder / "c.glb"));
}

TEST_F(ToolGlb, ShowsTheNeutralForAnEmptyListOfWeights) {
  Glb source = smallFace();
  source.json["meshes"][0]["weights"] = {0.5, 0.25};
  folder.file("face.glb", source.bytes());
  ASSERT_EQ(run("convert face.glb -o face.sweep --tolerance 0.05").code, 0);
  ASSERT_EQ(run("export face.sweep -o same.glb").code, 0);
  EXPECT_EQ(glb("same.glb").json["meshes"][0]["weights"], Json({0.5, 0.25}));
  ASSERT_EQ(run("export face.sweep -o none.glb --weights ''").code, 0);
  EXPECT_EQ(glb("none.glb").json["meshes"][0]["weights"], Json({0.0, 0.0}));
}

TEST_F(ToolGlb, GoesOnWithItsScene) {
  folder.file("face.glb", headAndHat().bytes());
  ASSERT_EQ(run("convert face.glb -o face.sweep --tolerance 0.05").code, 0);
  ASSERT_EQ(run("export face.sweep -o out.glb").code, 0);
  EXPECT_EQ(glb("out.glb").json["nodes"], headAndHat().json["nodes"]);
  ASSERT_EQ(run("export face.sweep -o far.glb --error 0.01").code, 0);
  EXPECT_EQ(glb("far.glb").json["nodes"], headAndHat().json["nodes"]);
  EXPECT_NE(glb("far.glb").indices().size(), glb("out.glb").indices().size());
  ASSERT_EQ(run("convert face.glb -o bare.sweep --tolerance 0.05 --bare").code, 0);
  ASSERT_EQ(run("export bare.sweep -o out.glb").code, 0);
  EXPECT_EQ(glb("out.glb").json["nodes"].size(), 1u);
}

TEST_F(ToolGlb, Animates) {
  convertRig();
  const Outcome r =
      run("animate face.sweep --to jawOpen=1 --law accelerate-brake --seconds 0.5 -o jaw.glb");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("jaw.glb: 0.5 s, accelerate-brake"), std::string::npos);
  const Json animation = glb("jaw.glb").json["animations"][0];
  EXPECT_EQ(animation["name"], "accelerate-brake");
  EXPECT_EQ(animation["samplers"][0]["interpolation"], "CUBICSPLINE");
  EXPECT_FALSE(std::filesystem::is_directory(folder / "jaw.glb"));

  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 --keys exact -o same.glb --law accelerate-brake "
                "--seconds 0.5")
                .code,
            0);
  EXPECT_EQ(contents(folder / "same.glb"), contents(folder / "jaw.glb"));
}

TEST_F(ToolGlb, FewKeysKeepTheirToleranceOfWhatIsPlayed) {
  convertRig();
  const auto bounce = [](double seconds, double restitution) {
    return *Trajectory::bounce({}, 1, seconds * (1 - restitution) / (1 + restitution), restitution);
  };
  const auto spring = [](double frequency, double damping) {
    return *Trajectory::spring({}, 1, {frequency, damping});
  };
  struct Case {
    std::string options;
    Trajectory path;
    double seconds = 1, tolerance = 0.002;
  };
  for (const auto& [options, path, seconds, tolerance] :
       {Case{"--law bounce", bounce(1, 0.4)},
        Case{"--law bounce --seconds 0.2 --restitution 0.6", bounce(0.2, 0.6), 0.2},
        Case{"--law bounce --restitution 0.99", bounce(1, 0.99)},
        Case{"--law spring --frequency 20 --damping 0.1", spring(20, 0.1)},
        Case{"--law spring --frequency 1920 --damping 0.01 --seconds 0.2", spring(1920, 0.01), 0.2},
        Case{"--law spring --damping 0.2 --key-tolerance 1e-4", spring(2, 0.2), 1, 1e-4}}) {
    ASSERT_EQ(run("animate face.sweep --to jawOpen=1 -o jaw.glb " + options).code, 0);
    const Written file = glb("jaw.glb");
    const Sampler keys(file, file.json["animations"][0], 0);
    double worst = 0;
    for (int k = 0; k <= 5000; ++k) {
      const double time = seconds * k / 5000;
      worst = std::max(worst, std::abs(keys.at(time)[0] - path.at(time).position));
    }
    EXPECT_LE(worst, tolerance + 1e-6) << options;
  }
}

TEST_F(ToolGlb, SaysWhenKeysCannotFollow) {
  convertRig();
  const Outcome r =
      run("animate face.sweep --to jawOpen=1 -o jaw.glb --law bounce --restitution 0.9999");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("bounce swings more quickly than keys can tell"), std::string::npos)
      << r.err;
}

TEST_F(ToolGlb, SamplesKeysOnRequest) {
  convertRig();
  for (const auto& [frames, count] : {std::pair{"", 31}, std::pair{" --frames 5", 5}}) {
    ASSERT_EQ(
        run(std::string("animate face.sweep --to jawOpen=1 --keys sampled -o jaw.glb") + frames)
            .code,
        0);
    const Written file = glb("jaw.glb");
    const Json& sampler = file.json["animations"][0]["samplers"][0];
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    EXPECT_EQ(file.accessor(sampler["input"])["count"], count);
  }
}

TEST_F(ToolGlb, RefusesOptionsThatDoNotGoTogether) {
  convertRig();
  folder.file("out.glb", "old");
  folder.file("folder.glb/file", "");
  EXPECT_TRUE(fails("export face.sweep -o out.obj --quantize", "is for .glb"));
  EXPECT_TRUE(fails("export face.sweep -o out.obj --morph-normals", "is for .glb"));
  EXPECT_TRUE(fails("export face.sweep -o out.gltf", "must end in"));
  EXPECT_TRUE(fails("export face.sweep -o folder.glb", "it is a folder"));
  EXPECT_TRUE(fails("export face.sweep -o out.glb --weights frown=1", "no target named 'frown'"));
  EXPECT_TRUE(fails("export face.sweep -o out.glb --weights smile=1e39", "within ±1,000,000"));
  EXPECT_TRUE(fails("export face.sweep -o out.glb --lod 2 --source-order", "--lod", 2));
  const std::string animate = "animate face.sweep --to smile=1 ";
  EXPECT_TRUE(fails(animate + "-o frames --keys exact", "are for .glb files"));
  EXPECT_TRUE(fails(animate + "-o frames --quantize", "is for .glb"));
  EXPECT_TRUE(fails(animate + "-o out.glb --keys few --frames 10", "leave --frames and --fps out"));
  EXPECT_TRUE(fails(animate + "-o out.glb --law spring --seconds 1e7", "too long to look for"));
  EXPECT_TRUE(
      fails(animate + "-o out.glb --keys exact --frames 10", "leave --frames and --fps out"));
  EXPECT_TRUE(fails(animate + "-o out.glb --keys some", "exact, few or sampled, not 'some'"));
  EXPECT_TRUE(fails(animate + "-o out.gltf", "must end in"));
  EXPECT_TRUE(fails(animate + "-o ''", "the output is empty"));
  EXPECT_TRUE(fails(animate + "-o folder.glb", "it is a folder"));
  EXPECT_TRUE(fails(animate + "-o out.glb --seconds 1e-44", "single precision"));
  EXPECT_TRUE(fails("animate face.sweep --to '' -o no/out.glb", "there is no folder no"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.gltf"));
  EXPECT_EQ(contents(folder / "out.glb"), "old");
}

}  // namespace
}  // namespace sweepface
