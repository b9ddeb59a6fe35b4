#include "cli/tool.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

class RegionsOnTheFace : public Tool {
 protected:
  /// The side x > 4 of the sheet is heavy.
  void heavySide(const std::string& more = "") {
    folder.file("heavy.json",
                R"({"regions": [{"name": "side", "line": [[6, 0, 0], [6, 6, 0]], "whole": 1,
                "fade": 2, "over": "space", "mass": 4)" +
                    more + "}]}");
  }
  std::vector<Vec3> frame(int number) {
    return mesh(fmt::format("frames/frame_{:04}.obj", number)).positions;
  }
  static double way(const std::vector<Vec3>& from, const std::vector<Vec3>& to, std::size_t v) {
    return norm(to[v] - from[v]);
  }
};

TEST_F(RegionsOnTheFace, AreThoseOfACaptureThatHasSome) {
  convertRig();
  folder.file("take.json", R"({"exportFps": 2, "facsNames": ["jawOpen"], "weightMat": [[0], [1]],
    "regions": [{"name": "side", "points": [[6, 0, 0]], "whole": 1, "fade": 2, "mass": 4}]})");
  ASSERT_EQ(run("animate face.sweep --clip take.json -o take.glb").code, 0);
  EXPECT_NE(contents(folder / "take.glb").find("jawOpen@"), std::string::npos);
}

TEST_F(RegionsOnTheFace, ReplaceThoseOfACapture) {
  convertRig();
  heavySide();
  const std::string clip = R"({"exportFps": 2, "facsNames": ["jawOpen"], "weightMat": [[0], [1]])";
  folder.file("take.json",
              clip + R"(, "regions": [{"name": "side", "points": [[0, 0, 0]], "fade": 2}]})");
  folder.file("plain.json", clip + "}");
  const auto said = [&](const std::string& take) {
    const Outcome r =
        run("animate face.sweep --clip " + take + " --regions heavy.json -o take.glb");
    EXPECT_EQ(r.code, 0) << r.err;
    return r.err;
  };
  EXPECT_NE(said("take.json").find("take.json: its own regions are not used, but those of heavy"),
            std::string::npos);
  EXPECT_EQ(said("plain.json").find("its own regions"), std::string::npos);
}

TEST_F(RegionsOnTheFace, AHeavySideTakesLonger) {
  convertRig();
  heavySide();
  const Outcome r = run(
      "animate face.sweep --to jawOpen=1 --law newton --regions heavy.json --frames 21 -o frames");
  ASSERT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(run("export face.sweep --weights jawOpen=1 -o open.obj").code, 0);
  const auto first = frame(0), open = mesh("open.obj").positions;
  EXPECT_NE(r.out.find("2 s"), std::string::npos) << r.out;  // √4 times as long
  EXPECT_EQ(frame(20), open);
  // After one of the two seconds, the light side has arrived, and the heavy one is a quarter there.
  const auto half = frame(10);
  const std::size_t left = 1, right = 6;  // x = 1 and x = 6 in the first row
  EXPECT_NEAR(way(first, half, left), way(first, open, left), 1e-9);
  EXPECT_NEAR(way(first, half, right), way(first, open, right) / 4, 1e-9);
}

TEST_F(RegionsOnTheFace, WithoutADifferenceNothingChanges) {
  convertRig();
  folder.file("same.json", R"({"regions": [{"name": "side", "points": [[6, 0, 0]], "fade": 3}]})");
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 --law spring -o plain.glb").code, 0);
  ASSERT_EQ(
      run("animate face.sweep --to jawOpen=1 --law spring --regions same.json -o same.glb").code,
      0);
  EXPECT_EQ(contents(folder / "plain.glb"), contents(folder / "same.glb"));
}

TEST_F(RegionsOnTheFace, AGlbHoldsPartsByName) {
  convertRig();
  heavySide();
  const Outcome r =
      run("animate face.sweep --to jawOpen=1 --law spring --regions heavy.json -o face.glb");
  ASSERT_EQ(r.code, 0) << r.err;
  const std::string glb = contents(folder / "face.glb");
  EXPECT_NE(glb.find(R"("jawOpen","smile","jawOpen@rest","jawOpen@side")"), std::string::npos);
}

// The frames of a late side lie between those of the rest, which keeps all of its own.
TEST_F(RegionsOnTheFace, LatePartsOfAClipLeaveTheRestItsFrames) {
  convertRig();
  folder.file("late.json", R"({"regions": [{"name": "side", "points": [[6, 0, 0]], "fade": 3,
              "over": "space", "delay": 0.5}]})");
  folder.file("take.csv", "Timecode,JawOpen\n0,0\n1,1\n2,0\n");
  for (const char* keys : {"few", "sampled"}) {
    const Outcome r = run(fmt::format(
        "animate face.sweep --clip take.csv --regions late.json -o face.glb --keys {}", keys));
    ASSERT_EQ(r.code, 0) << r.err;
    const Written file(contents(folder / "face.glb"));
    for (const auto& [time, rest, side] :
         {std::array{0.5, 0.5, 0.}, {1., 1., 0.5}, {1.5, 0.5, 1.}, {2.25, 0., 0.25}}) {
      const auto weights = evaluate(file, file.json["animations"][0], 0, time);
      EXPECT_NEAR(weights[0] + weights[2], rest, 3e-3) << keys << " " << time;
      EXPECT_NEAR(weights[0] + weights[3], side, 3e-3) << keys << " " << time;
    }
  }
}

TEST_F(RegionsOnTheFace, GoIntoTheSceneThatTheFaceCameFrom) {
  convertRig();
  heavySide();
  ASSERT_EQ(run("export face.sweep -o source.glb").code, 0);
  ASSERT_EQ(run("convert source.glb -o again.sweep --tolerance 0.01").code, 0);
  const Outcome r =
      run("animate again.sweep --to jawOpen=1 --law spring --regions heavy.json -o face.glb");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(
      contents(folder / "face.glb").find(R"("jawOpen","smile","jawOpen@rest","jawOpen@side")"),
      std::string::npos);
  EXPECT_EQ(run("convert face.glb -o third.sweep --tolerance 0.01").code, 0);
}

TEST_F(RegionsOnTheFace, ComeWithTheTimeline) {
  convertRig();
  folder.file("line.json", R"({"seconds": 1,
    "regions": [{"name": "side", "line": [[6, 0, 0], [6, 6, 0]], "whole": 1, "fade": 2,
                 "over": "space", "delay": 0.5}],
    "events": [{"at": 0, "to": {"jawOpen": 1}, "drive": "cut"},
               {"at": 0.75, "to": {"smile": 1}, "drive": "cut", "region": "rest"}]})");
  const Outcome r = run("animate face.sweep --clip line.json --fps 8 -o frames");
  ASSERT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(run("export face.sweep --weights jawOpen=1 -o open.obj").code, 0);
  ASSERT_EQ(run("export face.sweep -o rest.obj").code, 0);
  const auto open = mesh("open.obj").positions, rest = mesh("rest.obj").positions;
  EXPECT_LE(norm(frame(2)[1] - open[1]), 1e-9);
  EXPECT_LE(norm(frame(2)[6] - rest[6]), 1e-9);
  EXPECT_LE(norm(frame(5)[6] - open[6]), 1e-9);
  EXPECT_GT(norm(frame(8)[1] - open[1]), 0.01);  // smiles
  EXPECT_LE(norm(frame(8)[6] - open[6]), 1e-9);
}

TEST_F(RegionsOnTheFace, SayWhatIsWrong) {
  convertRig();
  const std::string command = "animate face.sweep --to smile=1 -o out.glb --regions ";
  EXPECT_TRUE(fails(command + "none.json", "none.json"));
  folder.file("empty.json", "{}");
  EXPECT_TRUE(fails(command + "empty.json", "has no regions"));
  folder.file("part.json", R"({"regions": [{"name": "a", "parts": ["nose"]}]})");
  folder.file("far.json",
              R"({"regions": [{"name": "a", "points": [[9, 9, 9]], "over": "space"}]})");
  EXPECT_TRUE(fails(command + "far.json", "Region 'a': The brush reaches no node of the face"));
  EXPECT_TRUE(fails(command + "part.json", "no material or group named 'nose'; it has lips, skin"));
  folder.file("line.json", R"({"seconds": 1, "events": [
    {"at": 0, "to": {"smile": 1}, "region": "nose"}]})");
  EXPECT_TRUE(fails("animate face.sweep -o out.glb --clip line.json", "a region 'nose'"));
  folder.file("line.json", R"({"seconds": 1, "events": [
    {"at": 0, "to": {"smile": 1}, "r\u0065gion": "nose"}]})");
  EXPECT_TRUE(fails("animate face.sweep -o out.glb --clip line.json", "a region 'nose'"));
}

TEST_F(RegionsOnTheFace, SpringsAreToldOnlyWhereHeavyPartsOfAClipHangOnThem) {
  convertRig();
  heavySide();
  folder.file("late.json", R"({"regions": [{"name": "side", "points": [[6, 0, 0]], "fade": 3,
              "over": "space", "delay": 0.5}]})");
  folder.file("take.csv", "Timecode,JawOpen\n0,0\n1,1\n2,0\n");
  folder.file("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  const std::string command = "animate face.sweep -o out.glb --frequency 3 --clip ";
  EXPECT_EQ(run(command + "take.csv --regions heavy.json").code, 0);
  EXPECT_TRUE(fails(command + "take.csv --regions late.json", "No region is heavier"));
  EXPECT_TRUE(fails(command + "take.csv", "leave --frequency and --damping out"));
  EXPECT_TRUE(fails(command + "line.json --regions heavy.json", "line.json is a timeline"));
}

}  // namespace
}  // namespace sweepface
