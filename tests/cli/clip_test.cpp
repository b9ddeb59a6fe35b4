#include "sweepface/clip.hpp"

#include <fstream>
#include <sys/stat.h>

#include "sweepface/gltf.hpp"
#include "sweepface/trajectory.hpp"

#include "cli/tool.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

class PlayClip : public Tool {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  }
  std::vector<Vec3> frame(int number) {
    return mesh(fmt::format("frames/frame_{:04}.obj", number)).positions;
  }
  std::vector<Vec3> exported(const std::string& weights) {
    EXPECT_EQ(run("export face.sweep -o out.obj --weights '" + weights + "'").code, 0);
    return mesh("out.obj").positions;
  }
};

TEST_F(PlayClip, NamesTheFirstOfMany) {
  convertRig();
  write("take.csv", "Timecode,JawOpen,a,b,c,d,e,f,g\n0,0,1,1,1,1,1,1,1\n1,1,1,1,1,1,1,1,1\n");
  const Outcome r = run("animate face.sweep --clip take.csv -o take.glb");
  EXPECT_NE(r.err.find("7 of 8 names drive no target of the face: a, b, c, d, e, f and 1 more."),
            std::string::npos)
      << r.err;
}

TEST_F(PlayClip, DoesNotTellATimelineWhatItLeavesAlone) {
  convertRig();
  write("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  EXPECT_EQ(run("animate face.sweep --clip line.json -o line.glb").err, "");
}

TEST_F(PlayClip, DrivesWhatAFileOfNamesSays) {
  convertRig();
  write("take.csv", "Timecode,BlendShapeCount,TongueOut,smile\n0,2,0,0.5\n1,2,0.5,0.5\n");
  write("names.json", R"({"tongueOut": {"jawOpen": 2}, "beard": "smile"})");
  const Outcome r =
      run("animate face.sweep --clip take.csv --clip-names names.json --fps 1 -o frames");
  ASSERT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "sweepface: warning: names.json: the clip has no beard.\n");
  EXPECT_EQ(frame(0), exported("smile=0.5"));
  EXPECT_EQ(frame(1), exported("smile=0.5,jawOpen=1"));
  write("wrong.json", R"({"tongueOut": "jaw"})");
  const std::string animate = "animate face.sweep -o none ";
  EXPECT_TRUE(fails(animate + "--clip take.csv --clip-names wrong.json",
                    "wrong.json: 'tongueOut' drives 'jaw', which is no target of the face"));
  EXPECT_TRUE(fails(animate + "--clip take.csv --clip-names lost.json", "lost.json"));
  write("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  EXPECT_TRUE(fails(animate + "--clip line.json --clip-names names.json", "is a timeline"));
  EXPECT_TRUE(fails(animate + "--to smile=1 --clip-names names.json", "--clip", 2));
}

TEST_F(PlayClip, PlaysACaptureByName) {
  convertRig();
  write("take.csv",
        "Timecode,BlendShapeCount,JawOpen,Beard\n1:0:0:0,2,0,9\n1:0:0:30,2,1,9\n1:0:1:0,2,0,9\n");
  const Outcome r = run("animate face.sweep --clip take.csv --fps 4 -o frames");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("drive no target of the face: Beard"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("nothing drives 1 of 2 targets: smile."), std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("whichever is largest"), std::string::npos) << r.err;
  EXPECT_EQ(frame(2), exported("jawOpen=1"));
  EXPECT_EQ(frame(1), exported("jawOpen=0.5"));
  EXPECT_EQ(frame(4), exported(""));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames/frame_0005.obj"));
}

TEST_F(PlayClip, PlaysATimeline) {
  convertRig();
  write("scene.json", R"({"seconds": 2, "events": [
    {"at": 0, "to": {"jawOpen": 1}, "drive": "newton", "seconds": 1},
    {"at": 1, "only": {"smile": 1}, "drive": "cut"}]})");
  ASSERT_EQ(run("animate face.sweep --clip scene.json --frames 5 --quiet -o frames").code, 0);
  EXPECT_EQ(frame(1), exported("jawOpen=0.25"));
  EXPECT_EQ(frame(4), exported("smile=1"));
}

/// A pipe can be read only once.
TEST_F(PlayClip, PlaysATimelineFromAPipe) {
  convertRig();
  write("scene.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}}]})");
  ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
  const Outcome r =
      run("animate face.sweep --clip scene.json --frames 2 --quiet -o frames && "
          "(cat scene.json > pipe.json & timeout 60 '" SWEEPFACE_TOOL
          "' animate face.sweep --clip pipe.json --frames 2 --quiet -o again)");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(contents(folder / "again/frame_0001.obj"), contents(folder / "frames/frame_0001.obj"));
}

TEST_F(PlayClip, SaysWhereSeveralNamesDriveOneTarget) {
  convertRig();
  write("take.csv", "Timecode,JawOpen,jaw_open,smile\n0,0,0,0\n0.5,0.25,0.5,1\n");
  const Outcome r = run("animate face.sweep --clip take.csv --frames 2 -o frames");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("take.csv: JawOpen and jaw_open drive the target jawOpen, whichever is "
                       "largest."),
            std::string::npos)
      << r.err;
  EXPECT_EQ(frame(1), exported("jawOpen=0.5,smile=1"));
}

TEST_F(PlayClip, SaysWhatMatchesNothingEvenWhenQuiet) {
  convertRig();
  write("take.csv", "Timecode,JawOpen,Beard\n0,0,1\n0.1,1,1\n");
  const Outcome r = run("animate face.sweep --clip take.csv --quiet -o take.glb");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out, "");
  EXPECT_NE(r.err.find("1 of 2 names drive no target of the face: Beard."), std::string::npos);
}

// JSON can spell any character: escape sequences for colours and titles would reach the terminal.
TEST_F(PlayClip, ShowsNoControlCharactersOfNames) {
  convertRig();
  write("take.json", R"({"exportFps": 30, "facsNames": ["jawOpen", "\u001b[31mred\u007f\u009b"],
                         "weightMat": [[0, 0], [1, 1]]})");
  const Outcome r = run("animate face.sweep --clip take.json -o take.glb");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("no target of the face: ?[31mred??."), std::string::npos) << r.err;
}

TEST_F(PlayClip, GivesAGlbAKeyAFrameOnRequest) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n0.1,1\n0.3,0.5\n");
  ASSERT_EQ(run("animate face.sweep --clip take.csv --keys sampled -o take.glb").code, 0);
  const std::string glb = contents(folder / "take.glb");
  EXPECT_NE(glb.find(R"("name":"take")"), std::string::npos);
  EXPECT_NE(glb.find(R"("interpolation":"LINEAR")"), std::string::npos);
}

/// A capture of a mouth that opens and shuts, with a tracker's jitter.
std::string capture(int seconds) {
  std::string text = "Timecode,BlendShapeCount,JawOpen,Smile\n";
  for (int f = 0; f < 60 * seconds; ++f)
    text += fmt::format("01:00:{:02}:{:02}.000,61,{},{}\n", f / 60, f % 60,
                        0.5 - 0.5 * std::cos(f * 0.05) + 1e-4 * std::sin(97.0 * f),
                        0.4 + 0.4 * std::sin(f * 0.021));
  return text;
}

TEST_F(PlayClip, FewKeysHoldACapture) {
  convertRig();
  write("take.csv", capture(20));
  ASSERT_EQ(run("animate face.sweep --clip take.csv -o few.glb").code, 0);
  ASSERT_EQ(run("animate face.sweep --clip take.csv --keys sampled -o all.glb").code, 0);
  const auto clipOf = [&](const char* file) {
    return *parseGltfClip(contents(folder / file), file, {});
  };
  const Clip few = clipOf("few.glb"), all = clipOf("all.glb");
  ASSERT_EQ(all.times.size(), 1200u);
  std::vector<double> weights(2);
  for (std::size_t f = 0; f < all.times.size(); ++f) {
    few.at(all.times[f], weights);
    for (std::size_t k : {0, 1}) EXPECT_NEAR(weights[k], all.weights[2 * f + k], 0.0022);
  }
  const std::string glb = contents(folder / "few.glb");
  EXPECT_NE(glb.find(R"("interpolation":"CUBICSPLINE")"), std::string::npos);
  EXPECT_LT(glb.size() + 10'000, contents(folder / "all.glb").size());
}

// Late in a clip, frames around a jump are closer together than times of keys can be.
TEST_F(PlayClip, KeysHoldATimelineThatJumps) {
  convertRig();
  for (const double start : {0.4, 300.0})
    for (const std::string keys : {"few", "sampled"}) {
      write("line.json", fmt::format(R"({{"seconds": {}, "events": [
        {{"at": {}, "to": {{"jawOpen": 1}}, "drive": "cut"}},
        {{"at": {}, "to": {{"jawOpen": 0}}, "drive": "spring", "frequency": 3, "damping": 0.2}}]}})",
                                     start + 2, start + 0.1, start + 1.1));
      const Outcome r = run("animate face.sweep --clip line.json -o line.glb --keys " + keys);
      ASSERT_EQ(r.code, 0) << r.err;
      EXPECT_EQ(r.err.find("more quickly"), std::string::npos) << "a jump is meant: " << r.err;
      const Clip clip = *parseGltfClip(contents(folder / "line.glb"), "line.glb", {});
      const auto spring = Trajectory::spring({1, 0}, 0, {3, 0.2});
      std::vector<double> weights(clip.names.size());
      for (double t = -0.1; t < 2; t += 0.0031) {
        clip.at(start + t, weights);
        const double meant = t < 0.1 ? 0 : t < 1.1 ? 1 : spring->at(t - 1.1).position;
        EXPECT_NEAR(weights[0], meant, 0.003) << keys << " " << start + t;
      }
    }
}

// Single precision resolves thousandths of a second there.
TEST_F(PlayClip, SaysWhatKeysCannotHoldLateInALongTake) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n9000,0\n9000.016,1\n9000.032,0\n9001,0\n");
  const std::string command = "animate face.sweep --clip take.csv -o take.glb --key-tolerance ";
  const Outcome told = run(command + "0.002");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_TRUE(told.err.contains("take.csv swings more quickly than keys can tell")) << told.err;
  EXPECT_FALSE(run(command + "0.1").err.contains("quickly"));
}

TEST_F(PlayClip, OfOneFrameHasOneKey) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0.5\n");
  const std::string command = "animate face.sweep --clip take.csv -o again";
  for (const char* kind : {".glb", ".csv"}) {
    EXPECT_EQ(run(command + kind).code, 0);
    EXPECT_TRUE(fails(command + kind + " --frames 5", "take.csv has one frame, which is one key"));
  }
}

TEST_F(PlayClip, KeysTellWhatHappensBetweenFrames) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n1,1\n61,0\n");
  ASSERT_EQ(run("animate face.sweep --clip take.csv --limits 0:0.5 -o take.glb").code, 0);
  const Clip clip = *parseGltfClip(contents(folder / "take.glb"), "take.glb", {});
  std::vector<double> weights(clip.names.size());
  for (const auto& [time, meant] :
       {std::pair{0.25, 0.25}, {0.75, 0.5}, {21.0, 0.5}, {46.0, 0.25}}) {
    clip.at(time, weights);
    EXPECT_NEAR(weights[0], meant, 0.0021) << time;
  }
}

TEST_F(PlayClip, PlaysAnAnimationOfAGlb) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1,smile=0.5 --law newton -o move.glb").code, 0);
  ASSERT_EQ(run("animate face.sweep --clip move.glb --frames 3 -o frames").code, 0);
  EXPECT_LE(largestDistance(frame(1), exported("jawOpen=0.25,smile=0.125")), 1e-4);
  EXPECT_LE(largestDistance(frame(2), exported("jawOpen=1,smile=0.5")), 1e-6);
  EXPECT_TRUE(fails("animate face.sweep --clip move.glb --animation walk -o frames", "'walk'"));
  // Its name identifies it among several.
  ASSERT_EQ(run("animate face.sweep --clip move.glb -o again.glb").code, 0);
  EXPECT_EQ(Written(contents(folder / "again.glb")).json["animations"][0]["name"], "move newton");
}

TEST_F(PlayClip, PlaysAnAnimationOfAGltfOfTheCurrentFolder) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to smile=1 --law linear -o move.glb").code, 0);
  Written move(contents(folder / "move.glb"));
  move.json["buffers"][0]["uri"] = "move.bin";
  folder.file("move.gltf", move.json.dump());
  folder.file("move.bin", move.binary);
  const Outcome r = run("animate face.sweep --clip move.gltf --frames 3 -o frames");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_LE(largestDistance(frame(2), exported("smile=1")), 1e-6);
}

TEST_F(PlayClip, RecordsWhatItPlays) {
  convertRig();
  write("take.csv", capture(2));
  ASSERT_EQ(run("animate face.sweep --clip take.csv -o again.csv").code, 0);
  const Outcome again = run("animate face.sweep --clip again.csv -o third.csv");
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "") << "of shapes that are 0 throughout";
  EXPECT_EQ(contents(folder / "again.csv"), contents(folder / "third.csv"));
  const auto clip = parseLiveLinkCsv(contents(folder / "again.csv"), "again.csv");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->times.size(), 120u);
  ASSERT_EQ(run("animate face.sweep --to smile=1 --law spring -o spring.csv").code, 0);
  EXPECT_EQ(parseLiveLinkCsv(contents(folder / "spring.csv"), "s.csv")->times.size(), 61u);
  for (const std::string option : {"--arcs on", "--eyes on", "--combine"})
    EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o a.csv " + option, "leave --regions"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 --eyes on -o a.csv", "--eyes"));
}

TEST_F(PlayClip, NeverWritesOverWhatItReads) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 -o take.glb").code, 0);
  write("take.csv", "Timecode,JawOpen\n0,0\n1,1\n");
  write("regions.json", R"({"regions": [{"name": "all", "points": [[0, 0, 0]], "whole": 99}]})");
  std::filesystem::create_symlink("take.csv", folder / "same.csv");
  std::filesystem::create_symlink("take.csv", folder / "same.svg");
  std::filesystem::create_symlink("regions.json", folder / "same.glb");
  for (const std::string what :
       {"animate face.sweep --clip take.glb -o take.glb",
        "animate face.sweep --clip take.csv -o same.csv",
        "animate face.sweep --to smile=1 --regions regions.json -o same.glb",
        "plot face.sweep --clip take.csv -o same.svg"})
    EXPECT_TRUE(fails(what, "it is what is read")) << what;
  EXPECT_TRUE(contents(folder / "take.glb").starts_with("glTF"));
}

TEST_F(PlayClip, SpringsSwingIntoTheirGoal) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 --law spring --frequency 1 --damping 0.2 "
                "--seconds 0.5 --frames 2 -o frames")
                .code,
            0);
  const auto from = exported(""), to = exported("jawOpen=1"), found = frame(1);
  EXPECT_GT(norm(found.back() - from.back()), 1.2 * norm(to.back() - from.back()));
}

TEST_F(PlayClip, RefusesWhatCannotBe) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n1,0\n0,1\n");
  write("other.csv", "Timecode,beard\n0,0\n");
  write("take.txt", "");
  const std::string command = "animate face.sweep -o frames ";
  EXPECT_TRUE(fails(command + "--clip none.csv", "there is no such file"));
  EXPECT_TRUE(fails(command + "--clip take.csv",
                    "take.csv, line 3: the timecode '0' is before the one above"));
  EXPECT_TRUE(fails(command + "--clip other.csv", "none of its 1 names is a target"));
  EXPECT_TRUE(fails(command + "--clip take.txt", "neither a .csv, a .json, a .glb, a .gltf nor"));
  EXPECT_TRUE(fails(command + "--clip take.csv --to smile=1", "excludes", 2));
  EXPECT_TRUE(fails(command + "--to smile=1 --smooth", "--clip", 2));
  EXPECT_TRUE(fails(command, "Say where to go"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 --law spring --keys exact -o a.glb",
                    "Keys cannot hold spring exactly"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames"));
}

TEST_F(PlayClip, TimelinesHaveNoFramesASecond) {
  convertRig();
  write("line.json", R"({"seconds": 1, "events": [{"at": 0, "to": {"jawOpen": 1}}]})");
  const std::string command = "animate face.sweep --clip line.json --clip-fps 30 -o out";
  EXPECT_TRUE(
      fails(command + ".glb", "line.json is a timeline; leave --smooth, --animation, --clip-fps"));
  EXPECT_EQ(run(command + ".csv").code, 0) << "which is the recording's";
}

TEST_F(PlayClip, SaysWhereAFileTellsItsTimesItself) {
  convertRig();
  write("take.json", R"({"exportFps": 30, "facsNames": ["jawOpen"], "weightMat": [[0], [1]]})");
  const Outcome told = run("animate face.sweep --clip take.json --clip-fps 10 -o take.glb");
  EXPECT_NE(told.err.find("--clip-fps changes nothing"), std::string::npos) << told.err;
  const Outcome written = run("animate face.sweep --clip take.json --clip-fps 10 -o take.csv");
  EXPECT_EQ(written.err.find("--clip-fps"), std::string::npos) << "which is the recording's";
}

TEST_F(PlayClip, PlaysAPartOfAClip) {
  convertRig();
  write("take.csv", "Timecode,JawOpen,HeadYaw\n5,0,0\n6,1,0.1\n7,0,0.3\n");
  const std::string part = "animate face.sweep --clip take.csv --clip-from 0.5 --clip-to 1.75 ";
  ASSERT_EQ(run(part + "--fps 2 -o frames").code, 0);
  EXPECT_EQ(frame(0), exported("jawOpen=0.5"));
  EXPECT_EQ(frame(1), exported("jawOpen=1"));
  EXPECT_EQ(frame(2), exported("jawOpen=0.5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "frames/frame_0003.obj"));
  // Its own frame and one at each end, with the head.
  ASSERT_EQ(run(part + "-o part.csv").code, 0);
  const Clip clip = *parseLiveLinkCsv(contents(folder / "part.csv"), "part.csv");
  ASSERT_EQ(clip.times, (std::vector{0.0, 0.5, 1.25}));
  const auto column = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(clip.names, name) - clip.names.begin());
  };
  std::vector<double> row(clip.names.size());
  for (const auto& [time, jaw, yaw] :
       {std::tuple{0.0, 0.5, 0.05}, {0.5, 1, 0.1}, {1.25, 0.25, 0.25}}) {
    clip.at(time, row);
    EXPECT_NEAR(row[column("JawOpen")], jaw, 1e-6) << time;
    EXPECT_NEAR(row[column("HeadYaw")], yaw, 1e-6) << time;
  }
  EXPECT_NE(run(part + "-o part.glb").out.find("part.glb: 1.25 s"), std::string::npos);
}

// Smoothing, mass and delay depend on what comes before the part.
TEST_F(PlayClip, APartIsPlayedAsInTheWhole) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n1,1\n1.5,0.2\n2,1\n3,0\n");
  write("heavy.json", R"({"regions": [{"name": "side", "points": [[6, 0, 0]], "fade": 3, "mass": 4,
                                       "delay": 0.1}]})");
  const std::string whole =
      "animate face.sweep --clip take.csv --smooth --regions heavy.json --fps 2 -o ";
  ASSERT_EQ(run(whole + "whole").code, 0);
  ASSERT_EQ(run(whole + "frames --clip-from 1 --clip-to 2.5").code, 0);
  for (int k = 0; k < 4; ++k) {
    const auto wanted = mesh(fmt::format("whole/frame_{:04}.obj", k + 2)).positions;
    const auto found = frame(k);
    for (std::size_t v = 0; v < wanted.size(); ++v)
      EXPECT_LE(norm(found[v] - wanted[v]), 1e-9) << k;
  }
}

TEST_F(PlayClip, SaysWhereAPartIsNone) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n1,1\n2,0\n");
  const std::string command = "animate face.sweep --clip take.csv -o part.glb ";
  EXPECT_TRUE(
      fails(command + "--clip-from 2", "take.csv lasts 2 s, of which nothing is left from"));
  EXPECT_TRUE(fails(command + "--clip-from 1 --clip-to 1",
                    "--clip-to 1 is no later than --clip-from 1; give a later one"));
  EXPECT_TRUE(fails(command + "--clip-from -1", "--clip-from", 2));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 --clip-to 1 -o part.glb",
                    "--clip-to requires --clip", 2));
  EXPECT_FALSE(std::filesystem::exists(folder / "part.glb"));
  const Outcome r = run(command + "--clip-from 1.5 --clip-to 9");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("take.csv ends after 2 s, before --clip-to 9."), std::string::npos) << r.err;
  EXPECT_NE(r.out.find("part.glb: 0.5 s"), std::string::npos) << r.out;
}

TEST_F(PlayClip, SaysWhatItMendedInAFile) {
  convertRig();
  write("take.csv", "Timecode,JawOpen\n0,0\n1,0.5\n1,1\n");
  const Outcome twice = run("animate face.sweep --clip take.csv -o take.glb");
  EXPECT_EQ(twice.code, 0);
  EXPECT_NE(twice.err.find("take.csv: 1 of 3 rows, the first in line 4"), std::string::npos);
  EXPECT_TRUE(fails("animate face.sweep --clip take.csv --head on -o take.glb",
                    "take.csv has no angles of the head; leave --head out."));
  write("take.json", R"([{"categories": [{"categoryName": "JawOpen", "score": 1}]},
                         {"categories": []}, {"categories": []}])");
  EXPECT_TRUE(
      fails("animate face.sweep --clip take.json -o lost.glb", "no 'timestampMs' in frame 0"));
  const Outcome lost = run("animate face.sweep --clip take.json --clip-fps 2 -o lost.glb");
  EXPECT_EQ(lost.code, 0) << lost.err;
  EXPECT_NE(lost.err.find("2 of 3 frames found no face"), std::string::npos) << lost.err;
  EXPECT_NE(lost.out.find("lost.glb: 1 s"), std::string::npos) << lost.out;
}

}  // namespace
}  // namespace sweepface
