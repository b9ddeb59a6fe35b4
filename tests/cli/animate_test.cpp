#include "sweepface/clip.hpp"
#include "sweepface/gltf.hpp"

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Animate : public Tool {
 protected:
  /// The values of a weight in a recording.
  std::vector<double> recorded(const std::string& file, const std::string& weight) {
    const auto clip = parseLiveLinkCsv(contents(folder / file), file);
    std::vector<double> found;
    const auto column = std::ranges::find(clip->names, weight) - clip->names.begin();
    for (std::size_t f = 0; f < clip->times.size(); ++f)
      found.push_back(clip->weights[f * clip->names.size() + column]);
    return found;
  }
  std::vector<Vec3> frame(int number) {
    return mesh(fmt::format("frames/frame_{:04}.obj", number)).positions;
  }
  std::vector<Vec3> exported(const std::string& weights) {
    EXPECT_EQ(run("export face.sweep -o out.obj --weights '" + weights + "'").code, 0);
    return mesh("out.obj").positions;
  }
};

TEST_F(Animate, ObeysNewton) {
  convertRig();
  const Outcome r = run("animate face.sweep --to jawOpen=1,smile=0.5 --frames 11 -o frames/");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto first = exported(""), last = exported("jawOpen=1,smile=0.5");
  for (int f = 0; f <= 10; ++f) {
    const double t = f / 10.0;
    const auto found = frame(f);
    ASSERT_EQ(found.size(), first.size());
    for (std::size_t v = 0; v < found.size(); ++v)
      EXPECT_LE(norm(found[v] - (first[v] + (last[v] - first[v]) * (t * t))), 1e-13);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "frames/frame_0011.obj"));
}

TEST_F(Animate, BeginsAndEndsWhereItIsTold) {
  convertRig();
  for (const std::string law : {"linear", "newton", "brake", "accelerate-brake", "linear-force"}) {
    ASSERT_EQ(run("animate face.sweep --from smile=0.3 --to jawOpen=0.7 --seconds 0.3 --frames 4 "
                  "-o frames --law " +
                  law)
                  .code,
              0);
    EXPECT_EQ(frame(0), exported("smile=0.3")) << law;
    EXPECT_EQ(frame(3), exported("jawOpen=0.7")) << law;
  }
}

TEST_F(Animate, HasLawsThatDiffer) {
  convertRig();
  std::vector<double> ways;
  const auto first = exported(""), last = exported("jawOpen=1");
  for (const std::string law : {"linear", "newton", "brake", "accelerate-brake", "linear-force"}) {
    ASSERT_EQ(run("animate face.sweep --to jawOpen=1 --frames 5 -o frames --law " + law).code, 0);
    ways.push_back(norm(frame(1).back() - first.back()) / norm(last.back() - first.back()));
  }
  const std::vector<double> expected{0.25, 0.0625, 0.4375, 0.125, 0.15625};
  for (std::size_t k = 0; k < ways.size(); ++k) EXPECT_NEAR(ways[k], expected[k], 1e-12);
}

TEST_F(Animate, SaysWhichTargetsMoveNothing) {
  folder.file("targets/wink.obj", sheet());
  convertRig();
  for (const std::string command :
       {"animate face.sweep -o move.glb", "plot face.sweep -o move.svg"}) {
    EXPECT_EQ(run(command + " --to jawOpen=1 --law newton").err, "");
    EXPECT_TRUE(run(command + " --to jawOpen=1,wink=1 --law newton")
                    .err.starts_with("sweepface: warning: wink moves nothing in this face"));
  }
  for (const std::string still : {"--to ''", "--to jawOpen=0", "--from smile=1 --to smile"})
    EXPECT_EQ(run("animate face.sweep -o move.glb " + still).err,
              "sweepface: warning: Nothing moves: --to is the expression that it starts from.\n");
  EXPECT_FALSE(run("animate face.sweep -o move.glb --to wink=1 --law newton --combine")
                   .err.contains("moves nothing"))
      << "what is combined with it may";
}

TEST_F(Animate, WritesFinerMeshes) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to smile=1 --frames 2 --lod 2 --quiet -o a/b/frames").code,
            0);
  EXPECT_EQ(mesh("a/b/frames/frame_0001.obj").polygons.faceCount(), 120);
}

TEST_F(Animate, ABounceFallsAndComesBack) {
  convertRig();
  const std::string command = "animate face.sweep --to smile=1 --law bounce --fps 100 -o take.csv";
  for (const double left : {0.2, 0.5}) {
    ASSERT_EQ(run(fmt::format("{} --restitution {}", command, left)).code, 0);
    const auto w = recorded("take.csv", "smile");
    ASSERT_EQ(w.size(), 101u);
    EXPECT_NEAR(w.back(), 1, 1e-6);
    // It falls for part of the time, and rebounds by the square of the share of speed that is left.
    const double fall = (1 - left) / (1 + left);
    const auto landed = static_cast<std::size_t>(std::lround(100 * fall));
    EXPECT_NEAR(w[landed], 1, 0.06);
    EXPECT_NEAR(*std::min_element(w.begin() + landed, w.end()), 1 - left * left, 0.02);
  }
}

TEST_F(Animate, KeysHoldTheEnd) {
  convertRig();
  for (const std::string options : {"--seconds 0.5 --fps 25", "--seconds 0.99"}) {
    ASSERT_EQ(run("animate face.sweep --to smile=1 -o take.csv " + options).code, 0);
    EXPECT_EQ(recorded("take.csv", "smile").back(), 1);
  }
}

TEST_F(Animate, ATimelinesEndIsKeptHoweverNearAFrame) {
  convertRig();
  for (const double end : {1.00005, 4.746, 600.1, 4100.0002}) {  // or less, in single precision
    folder.file("line.json", fmt::format(R"({{"seconds": {0}, "events": [
      {{"at": 0, "to": {{"jawOpen": 1}}, "drive": "linear-force", "seconds": 0.5}},
      {{"at": {0}, "to": {{"jawOpen": 0.25}}, "drive": "cut"}}]}})",
                                         end));
    for (const std::string options : {"", " --fps 2"}) {
      ASSERT_EQ(run("animate face.sweep --clip line.json -o line.csv" + options).code, 0);
      EXPECT_EQ(recorded("line.csv", "JawOpen").back(), 0.25) << end << options;
      ASSERT_EQ(run("animate face.sweep --clip line.json -o line.glb" + options).code, 0);
      const Clip clip = *parseGltfClip(contents(folder / "line.glb"), "line.glb", {});
      const auto jaw = std::ranges::find(clip.names, "jawOpen") - clip.names.begin();
      const auto last = clip.weights.end() - std::ssize(clip.names);
      EXPECT_NEAR(last[jaw], 0.25, 1e-6) << end << options;
    }
  }
}

TEST_F(Animate, SaysWhereFramesCannotFollow) {
  convertRig();
  folder.file("line.json", R"({"seconds": 1, "events": [
    {"at": 0, "to": {"jawOpen": 1}, "drive": "spring", "frequency": 5000, "damping": 0}]})");
  for (const std::string output : {"line.csv", "line.glb", "line"}) {
    const Outcome r = run("animate face.sweep --clip line.json -o " + output);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.err.find("than frames can tell: between them weights are off by 0.00"),
              std::string::npos)
        << r.err;
  }
  // Also if only a region is stiff.
  folder.file("line.json", R"({"seconds": 1,
    "regions": [{"name": "stiff", "points": [[0, 0, 0]], "whole": 1, "fade": 1, "stiffness": 10000}],
    "events": [{"at": 0, "to": {"jawOpen": 1}, "drive": "spring", "frequency": 50, "damping": 0}]})");
  for (const std::string command : {"animate face.sweep --clip line.json -o line.glb",
                                    "plot face.sweep --clip line.json -o line.svg"}) {
    const Outcome r = run(command);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.err.find("than frames can tell"), std::string::npos) << r.err;
  }
}

TEST_F(Animate, IsNoLongerThanItsMotion) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to smile=1 --seconds 0.25 --fps 1 -o take.csv").code, 0);
  const std::string text = contents(folder / "take.csv");
  EXPECT_NE(text.find("\n00:00:00:15.000,"), std::string::npos) << text;
}

TEST_F(Animate, LeavesOnlyWholeFramesOnInterrupt) {
  convertRig();
  const std::filesystem::path face = folder / "face.sweep", frames = folder / "frames";
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    std::filesystem::remove_all(frames);
    const pid_t child = start(
        {"animate", face.string(), "--to", "smile=1", "--frames", "100000", "-o", frames.string()});
    ASSERT_GE(child, 0);
    while (!std::filesystem::exists(frames / "frame_0000.obj") &&
           waitpid(child, nullptr, WNOHANG) == 0)
      usleep(1000);
    kill(child, signal);
    EXPECT_EQ(codeOf(child), 130);
    EXPECT_TRUE(contents(folder / ".err").starts_with("sweepface: Interrupted after "));
    const std::size_t faces = mesh("frames/frame_0000.obj").polygons.faceStart.size();
    for (const auto& file : std::filesystem::directory_iterator(frames)) {
      EXPECT_EQ(file.path().extension(), ".obj") << file.path();
      EXPECT_EQ(mesh(file.path().string()).polygons.faceStart.size(), faces) << file.path();
    }
  }
}

TEST_F(Animate, RefusesWhatWouldChangeNothing) {
  convertRig();
  folder.file("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  const std::string command = "animate face.sweep -o frames --to smile=1 ";
  EXPECT_TRUE(fails(command + "--frequency 3", "--frequency: Only spring swings", 2));
  EXPECT_TRUE(fails(command + "--law bounce --damping 0.5", "--damping: Only spring", 2));
  EXPECT_TRUE(fails(command + "--law spring --restitution 0.5", "--restitution: Only bounce", 2));
  EXPECT_TRUE(fails(command + "--clip-fps 30", "--clip-fps: Only a .csv has timecodes", 2));
  EXPECT_EQ(run("animate face.sweep --to smile=1 --clip-fps 30 -o take.csv").code, 0);
  EXPECT_TRUE(fails(command + "--pivot 1,2,3 --head off", "leave --pivot out"));
  EXPECT_EQ(run("plot face.sweep --to smile=1 --laws newton,spring --damping 0.5 -o a.svg").code,
            0);
}

// Neither meshes nor recordings nor keys that hold the law or the frames have a tolerance.
TEST_F(Animate, HasAToleranceForFewKeysOnly) {
  convertRig();
  const std::string command = "animate face.sweep --to smile=1 --key-tolerance 0.01 -o ";
  for (const std::string output : {"frames", "take.csv"})
    EXPECT_TRUE(fails(command + output, "are for .glb files")) << output;
  for (const std::string keys : {"", " --keys exact"})
    EXPECT_TRUE(fails(command + "a.glb" + keys, "that are exact have no tolerance")) << keys;
  for (const std::string keys : {" --keys sampled", " --frames 5"})
    EXPECT_TRUE(fails(command + "a.glb" + keys, "that are sampled have no tolerance")) << keys;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
  for (const std::string keys : {" --keys few", " --law spring"})
    EXPECT_EQ(run(command + "a.glb" + keys).code, 0) << keys;
}

TEST_F(Animate, TellsOneFrame) {
  convertRig();
  const Outcome r = run("animate face.sweep --to smile=1 --fps 0.5 -o frames");
  EXPECT_EQ(r.out.find("frames: 1 frame of 1 s"), 0u) << r.out;
}

TEST_F(Animate, RefusesWhatCannotBe) {
  convertRig();
  const std::string command = "animate face.sweep -o frames ";
  EXPECT_TRUE(fails(command + "--to frown=1", "--to: There is no target named 'frown'"));
  EXPECT_TRUE(
      fails(command + "--from frown=1 --to smile=1", "--from: There is no target named 'frown'"));
  EXPECT_TRUE(fails(command + "--to smile=0,5", "--to: Numbers have a point, as in 0.5. There is"));
  EXPECT_TRUE(
      fails("animate neutral.obj --to smile=1 -o frames", "not a face; make one of it first"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o -", "Standard output takes no meshes"));
  EXPECT_TRUE(fails(command + "--to smile=1 --law magic", "accelerate-brake"));
  EXPECT_TRUE(fails(command + "--to smile=1 --frames 1",
                    "--frames: This must be a whole number from 2", 2));
  EXPECT_TRUE(fails(command + "--to smile=1 --seconds 0", "--seconds", 2));
  EXPECT_TRUE(fails(command + "--to smile=1 --seconds 100000 --fps 100",
                    "more than 1000000 frames; play less of it"));
  EXPECT_TRUE(fails(command + "--to smile=1 --lod 99", "--lod", 2));
  folder.file("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  folder.file("divided.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}],
    "regions": [{"name": "up", "points": [[0, 0, 1]], "whole": 0.5, "fade": 1, "delay": 0.2}]})");
  EXPECT_TRUE(fails("animate face.sweep --clip divided.json -o divided.csv",
                    "divided.json has regions, which a .csv cannot tell apart"));
  folder.file("take.csv", "Timecode,smile\n0,0\n0.1,1\n");
  EXPECT_TRUE(fails(command + "--clip take.csv --law spring", "--law", 2));
  EXPECT_TRUE(fails(command + "--clip take.csv --seconds 3", "--seconds", 2));
  EXPECT_TRUE(fails(command + "--clip take.csv --animation walk", "no animations to choose from"));
  EXPECT_TRUE(fails(command + "--clip line.json --smooth", "leave --smooth"));
  EXPECT_TRUE(fails(command, "Say where to go"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o neutral.obj", "neutral.obj"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o neutral.obj/frames", "neutral.obj"));
  EXPECT_EQ(contents(folder / "neutral.obj"), sheet());
}

}  // namespace
}  // namespace sweepface
