#include "sweepface/head.hpp"

#include "sweepface/gltf.hpp"

#include "cli/tool.hpp"
#include "gltf/document.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

class HeadAndEyes : public Tool {
 protected:
  /// A capture in which the head turns to its left by half a radian, and the jaw opens.
  void capture() {
    std::string text = "Timecode,BlendShapeCount,JawOpen,HeadYaw,HeadPitch,HeadRoll\n";
    for (int f = 0; f <= 30; ++f)
      text += fmt::format("00:00:00:{:02},3,{},{},0,0\n", f, f / 30.0, -f / 60.0);
    folder.file("take.csv", text);
  }
  static gltf::Json jsonOf(const std::string& glb) {
    return gltf::parseDocument(glb, {}).value().json;
  }
};

TEST_F(HeadAndEyes, TheHeadTurnsInMeshes) {
  convertRig();
  capture();
  ASSERT_EQ(
      run("animate face.sweep --clip take.csv --head on --pivot 1,2,3 --frames 3 -o turned").code,
      0);
  ASSERT_EQ(run("animate face.sweep --clip take.csv --frames 3 -o still").code, 0);
  for (int f = 0; f < 3; ++f) {
    const auto still = mesh(fmt::format("still/frame_{:04}.obj", f)).positions,
               now = mesh(fmt::format("turned/frame_{:04}.obj", f)).positions;
    const Vec3 pivot{1, 2, 3};
    for (std::size_t v = 0; v < still.size(); ++v)
      EXPECT_LE(norm(now[v] - (pivot + turned(quaternionOf({0.25 * f, 0, 0}), still[v] - pivot))),
                1e-12);
  }
}

TEST_F(HeadAndEyes, TheHeadIsOfNoRegion) {
  convertRig();
  capture();
  folder.file("late.json", R"({"regions": [{"name": "all", "points": [[3, 3, 0]], "whole": 99,
              "over": "space", "delay": 0.2, "mass": 3}]})");
  const std::string command = "animate face.sweep --clip take.csv --head on --pivot 1,2,3 ";
  ASSERT_EQ(run(command + "--fps 60 -o plain").code, 0);
  ASSERT_EQ(run(command + "--fps 60 --regions late.json -o late").code, 0);
  // The jaw has not started yet; the head is turning.
  ASSERT_EQ(run("export face.sweep -o rest.obj").code, 0);
  const Vec3 pivot{1, 2, 3};
  const auto rest = mesh("rest.obj").positions, late = mesh("late/frame_0006.obj").positions;
  for (std::size_t v = 0; v < rest.size(); ++v)
    EXPECT_LE(norm(late[v] - (pivot + turned(quaternionOf({0.1, 0, 0}), rest[v] - pivot))), 1e-9);
}

TEST_F(HeadAndEyes, TheHeadIsANodeOfAGlb) {
  convertRig();
  capture();
  const Outcome r = run("animate face.sweep --clip take.csv --head on --pivot 1,2,3 -o take.glb");
  ASSERT_EQ(r.code, 0) << r.err;
  const gltf::Json json = jsonOf(contents(folder / "take.glb"));
  const std::size_t head = json["scenes"][0]["nodes"][0];
  EXPECT_EQ(json["nodes"][head]["name"], "head");
  EXPECT_EQ(json["nodes"][head]["translation"], gltf::Json::array({1.0, 2.0, 3.0}));
  const std::size_t contents = json["nodes"][head]["children"][0];
  EXPECT_EQ(json["nodes"][contents]["translation"], gltf::Json::array({-1.0, -2.0, -3.0}));
  EXPECT_EQ(json["nodes"][contents]["children"], gltf::Json::array({0}));
  const gltf::Json& channels = json["animations"][0]["channels"];
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[1]["target"]["path"], "rotation");
  EXPECT_EQ(channels[1]["target"]["node"], head);
}

// Angles that change together do not add up to a rotation about one axis.
TEST_F(HeadAndEyes, TheHeadTurnsBetweenFramesOfAGlb) {
  convertRig();
  folder.file("take.csv",
              "Timecode,JawOpen,HeadYaw,HeadPitch,HeadRoll\n0,0,0,0,0\n1,1,0.8,0.5,-0.3\n");
  ASSERT_EQ(run("animate face.sweep --clip take.csv --head on -o take.glb").code, 0);
  const Written glb(contents(folder / "take.glb"));
  const auto& turn = glb.json["animations"][0]["samplers"][1];
  const auto times = glb.stored(turn["input"]), rotations = glb.stored(turn["output"]);
  ASSERT_LE(times.size(), 20u);
  EXPECT_EQ(times.back(), 1);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double t = std::midpoint(times[k - 1], times[k]);
    const Quaternion meant = quaternionOf({-0.8 * t, 0.5 * t, 0.3 * t});
    double along = 0, square = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double sum = rotations[4 * (k - 1) + c] + rotations[4 * k + c];
      along += sum * meant[c], square += sum * sum;
    }
    EXPECT_GE(along / std::sqrt(square), std::cos(0.0011 / 2)) << t;
  }
}

TEST_F(HeadAndEyes, AnglesGoIntoRecordings) {
  convertRig();
  capture();
  ASSERT_EQ(run("animate face.sweep --clip take.csv -o again.csv").code, 0);
  const auto clip = parseLiveLinkCsv(contents(folder / "again.csv"), "again.csv");
  ASSERT_TRUE(clip);
  EXPECT_NEAR(ClipAngles(*clip).at(*clip, 0.5).head.yaw, 0.5, 1e-12);
}

TEST_F(HeadAndEyes, AnglesAreNamesThatTheCommandKnows) {
  convertRig();
  capture();
  const std::string command = "animate face.sweep --clip take.csv -o a.glb";
  const std::string still = run(command).err, turning = run(command + " --head on").err;
  EXPECT_NE(still.find("take.csv: its angles of the head are left out"), std::string::npos);
  EXPECT_EQ(turning.find("angles of the head"), std::string::npos) << turning;
  for (const std::string& said : {still, turning})
    EXPECT_EQ(said.find("drive no target"), std::string::npos) << said;
}

TEST_F(HeadAndEyes, AHeadThatNeverTurnsIsNotLeftOut) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 -o still.csv").code, 0);
  EXPECT_EQ(run("animate face.sweep --clip still.csv -o a.glb").err.find("angles of the head"),
            std::string::npos);
  EXPECT_EQ(run("animate face.sweep --clip still.csv --head on -o a.glb").code, 0);
}

TEST_F(HeadAndEyes, SayWhatIsMissing) {
  convertRig();
  capture();
  folder.file("plain.csv", "Timecode,JawOpen\n0,0\n1,1\n");
  EXPECT_TRUE(
      fails("animate face.sweep --clip plain.csv --head on -o a.glb", "no angles of the head"));
  EXPECT_TRUE(
      fails("animate face.sweep --to jawOpen=1 --head on -o a.glb", "no angles of the head"));
  for (const std::string pivot : {"1,2", "1e300,0,0", "nan,0,0"})
    EXPECT_TRUE(fails("animate face.sweep --clip take.csv --head on -o a.glb --pivot " + pivot,
                      "--pivot is a point like"));
  EXPECT_TRUE(
      fails("animate face.sweep --clip take.csv --head on -o a.glb --pivot ''", "--pivot", 2));
  EXPECT_TRUE(fails("animate face.sweep --clip take.csv --pivot 1,2,3 -o a.glb", "--head", 2));
  EXPECT_TRUE(fails("animate face.sweep --clip take.csv --head on -o a.csv", "leave --regions"));
  EXPECT_TRUE(fails("animate face.sweep --clip take.csv --head yes -o a.glb",
                    "--head: This must be on or off, not 'yes'.", 2));
  EXPECT_TRUE(fails("animate face.sweep --clip take.csv --eyes on -o a.glb", "no eyeballs"));
  EXPECT_TRUE(fails("export face.sweep --limits 2 -o a.obj", "--limits: Limits are like"));
}

TEST_F(HeadAndEyes, GlbsAreLimitedWhereTheyShowAnExpression) {
  convertRig();
  for (const std::string option : {"--limits 0:1", "--combine"}) {
    EXPECT_TRUE(fails("export face.sweep -o a.glb " + option, "the expression of --weights"));
    EXPECT_EQ(run("export face.sweep -o b.glb --weights smile=2 " + option).code, 0) << option;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
}

TEST_F(HeadAndEyes, LimitsStopWeights) {
  convertRig();
  ASSERT_EQ(
      run("export face.sweep --weights jawOpen=1.5,smile=-1 --limits 0:1,jawOpen=0:0.5 -o a.obj")
          .code,
      0);
  ASSERT_EQ(run("export face.sweep --weights jawOpen=0.5 -o b.obj").code, 0);
  EXPECT_EQ(mesh("a.obj").positions, mesh("b.obj").positions);
}

}  // namespace
}  // namespace sweepface
