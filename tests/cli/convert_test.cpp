#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Convert = Tool;

TEST_F(Convert, TellsProgramsHowFarItIs) {
  makeRig();
  const std::string convert = "convert neutral.obj targets -o face.sweep --tolerance 0.01";
  setenv("SWEEPFACE_PROGRESS", "1", 1);
  const Outcome told = run(convert), quiet = run(convert + " --quiet");
  unsetenv("SWEEPFACE_PROGRESS");
  EXPECT_TRUE(told.err.starts_with("sweepface: ")) << told.err;
  EXPECT_NE(told.err.find("sweepface: 100 % "), std::string::npos) << told.err;
  EXPECT_EQ(quiet.err, "");
  EXPECT_EQ(run(convert).err, "");
}

TEST_F(Convert, WarnsOfNamesThatCommandsCannotTake) {
  makeRig();
  folder.file("p,q.obj", sheet(opened));
  folder.file("r=s.obj", sheet(opened));
  const Outcome r =
      run("convert neutral.obj 'p,q.obj' 'r=s.obj' targets -o face.sweep --tolerance 0.1");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err.find("'r=s'"), std::string::npos) << r.err;
  EXPECT_EQ(run("export face.sweep -o out.obj --weights r=s=1").code, 0);
  EXPECT_NE(r.err.find("'p,q' is no name for a list of weights"), std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("'smile'"), std::string::npos) << r.err;
}

TEST_F(Convert, SaysWhatItMade) {
  makeRig();
  const Outcome r = run("convert neutral.obj targets -o face.sweep --tolerance 0.01");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_NE(r.out.find("of the source's 42 vertices), 2 targets\n"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find(" of 0.01 allowed"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find(fmt::format("{} bytes", contents(folder / "face.sweep").size())),
            std::string::npos)
      << r.out;
}

// In a target, a row of faces is a hundredth as wide: hardly more than the tolerance.
TEST_F(Convert, SaysWhereTheSurfaceFoldsOver) {
  folder.file("neutral.obj", sheet());
  folder.file("squash.obj",
              sheet([](Vec3 p) { return Vec3{p.x, p.y < 2.5 ? p.y : p.y - 1.089, p.z}; }));
  const std::string command =
      "convert neutral.obj squash.obj -o face.sweep --tolerance 0.009 --normal-limit 180";
  const Outcome r = run(command);
  EXPECT_EQ(r.code, 0) << r.err;
  const auto folds = nlohmann::json::parse(run(command + " --json").out)["folds"];
  EXPECT_EQ(folds[0], 0);
  ASSERT_GT(folds[1], 0);
  EXPECT_NE(r.out.find(fmt::format("\n{0} triangles fold over, most in squash ({0}); ",
                                   folds[1].get<int>())),
            std::string::npos)
      << r.out;
}

// Lashes and hair cards: faces modelled from both sides.
TEST_F(Convert, TakesFacesThatLieBackToBack) {
  folder.file("card.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n");
  for (const char* options : {"", " --pack"}) {
    const Outcome r = run(std::string("convert card.obj -o card.sweep --tolerance 0.05") + options);
    EXPECT_EQ(r.code, 0) << r.err;
    ASSERT_EQ(run("export card.sweep -o out.obj").code, 0);
    EXPECT_LE(largestDistance(mesh("out.obj").positions, mesh("card.obj").positions), 0.05);
  }
}

// Such regular parts take hardly any bytes; no limit on what so few bytes may hold gets in the way.
TEST_F(Convert, TakesMeshesOfManyParts) {
  std::string obj;
  for (int k = 0; k < 2000; ++k) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      obj += fmt::format("v {} {} 0\n", 3 * k + x, y);
    obj += "f -4 -3 -2 -1\n";
  }
  folder.file("cards.obj", obj);
  const Outcome r = run("convert cards.obj -o cards.sweep --pack --tolerance 0.05");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(run("info cards.sweep").code, 0);
}

TEST_F(Convert, KeepsToTheTolerance) {
  makeRig();
  for (const double tolerance : {0.1, 0.005}) {
    const Outcome r = run(
        fmt::format("convert neutral.obj targets -o face.sweep --json --tolerance {}", tolerance));
    ASSERT_EQ(r.code, 0) << r.err;
    const auto report = nlohmann::json::parse(r.out);
    EXPECT_EQ(report["tolerance"], tolerance);
    EXPECT_LE(report["worstDistance"], tolerance);
    EXPECT_EQ(report["targets"], 2);
    for (const std::string target : {"jawOpen", "smile"}) {
      ASSERT_EQ(run("export face.sweep -o out.obj --weights " + target + "=1").code, 0);
      EXPECT_LE(
          largestDistance(mesh("out.obj").positions, mesh("targets/" + target + ".obj").positions),
          tolerance);
    }
    ASSERT_EQ(run("export face.sweep -o out.obj").code, 0);
    EXPECT_LE(largestDistance(mesh("out.obj").positions, mesh("neutral.obj").positions), tolerance);
  }
}

TEST_F(Convert, CountsVerticesFrom0InTextAndJson) {
  makeRig();
  const std::string command = "convert neutral.obj targets -o face.sweep --tolerance 0.1";
  const auto worst = nlohmann::json::parse(run(command + " --json").out)["worstVertex"];
  const std::string text = run(command).out, told = fmt::format("at vertex {} of", worst.dump());
  EXPECT_NE(text.find(told), std::string::npos) << text;
}

TEST_F(Convert, TakesFilesInTheirOrderAndNoTargetsAtAll) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets/smile.obj targets/jawOpen.obj -o face.sweep "
                "--tolerance 0.01")
                .code,
            0);
  const auto info = nlohmann::json::parse(run("info face.sweep --json").out);
  EXPECT_EQ(info["targets"], (std::vector<std::string>{"smile", "jawOpen"}));
  ASSERT_EQ(run("convert neutral.obj -o still.sweep --tolerance 0.01").code, 0);
  EXPECT_TRUE(nlohmann::json::parse(run("info still.sweep --json").out)["targets"].empty());
}

TEST_F(Convert, MakesTheSameFileWithAnyNumberOfThreads) {
  convertRig("--threads 1");
  const std::string one = contents(folder / "face.sweep");
  convertRig("--threads 2");
  EXPECT_EQ(contents(folder / "face.sweep"), one);
}

// A trough with walls that shape parameters fit.
TEST_F(Convert, LeavesShapeParametersOutIfAsked) {
  std::string trough;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 8; ++i)
      trough += fmt::format("v {} {} {}\n", i, j,
                            1 - std::cosh(14.1 * (i / 8.0 - 0.5)) / std::cosh(7.05));
  for (int a = 1; a < 36; ++a)
    if (a % 9 != 0) trough += fmt::format("f {} {} {} {}\n", a, a + 1, a + 10, a + 9);
  folder.file("trough.obj", trough);
  const auto shapedRibbons = [&](const std::string& more) {
    const Outcome made = run(
        "convert trough.obj -o trough.sweep --tolerance 0.02 --normal-limit 180 --quiet " + more);
    EXPECT_EQ(made.code, 0) << made.err;
    return nlohmann::json::parse(run("info trough.sweep --json").out)["shapedRibbons"].get<int>();
  };
  EXPECT_GT(shapedRibbons(""), 0);
  EXPECT_EQ(shapedRibbons("--no-shapes"), 0);
}

TEST_F(Convert, IsSilentIfAskedAndLeavesNothingElse) {
  makeRig();
  const Outcome r =
      run("convert neutral.obj targets -o face.sweep --tolerance 0.01 --quiet --normal-limit 180");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out + r.err, "");
  for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(Convert, RefusesWrongNumbers) {
  makeRig();
  const std::string command = "convert neutral.obj -o face.sweep ";
  for (const std::string text : {"0", "-1", "nan", "inf", "much", "1e999", "1x"})
    EXPECT_TRUE(fails(command + "--tolerance " + text,
                      "--tolerance: This must be a finite number greater than 0", 2))
        << text;
  EXPECT_TRUE(fails(command + "--normal-limit 181", "at most 180", 2));
  EXPECT_TRUE(fails(command + "--threads 0", "--threads: This must be a whole number from 1", 2));
  EXPECT_FALSE(std::filesystem::exists(folder / "face.sweep"));
}

TEST_F(Convert, WarnsOfMovementWithinTheTolerance) {
  folder.file("neutral.obj", sheet());
  folder.file("tiny.obj",
              sheet([](Vec3 p) { return p.x == 3 && p.y == 2.2 ? p + Vec3{0, 0, 0.06} : p; }));
  const Outcome r = run("convert neutral.obj tiny.obj -o face.sweep --tolerance 0.1");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("is within the tolerance and lost in 'tiny' ("), std::string::npos) << r.err;
  EXPECT_EQ(run("convert neutral.obj tiny.obj -o face.sweep --tolerance 0.01").err, "");
}

TEST_F(Convert, LeavesTheOldFileWhereItFails) {
  makeRig();
  folder.file("face.sweep", "old");
  folder.file("fewer.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(fails("convert nothing.obj -o face.sweep", "nothing.obj"));
  EXPECT_TRUE(fails("convert neutral.obj nothing.obj -o face.sweep", "nothing.obj"));
  EXPECT_TRUE(fails("convert neutral.obj fewer.obj -o face.sweep", "fewer.obj has 3 vertices"));
  EXPECT_TRUE(fails("convert neutral.obj face.sweep -o other.sweep", "face.sweep"));
  EXPECT_EQ(contents(folder / "face.sweep"), "old");
}

TEST_F(Convert, SaysOfWhichMeshNothingCanBeMade) {
  folder.file("line.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n");
  EXPECT_TRUE(fails("convert line.obj -o face.sweep",
                    "line.obj: the mesh has no face with an area; nothing can be converted.\n"));
  EXPECT_TRUE(fails("convert line.obj -o face.sweep --max-bytes 1000", "line.obj: the mesh has"));
}

TEST_F(Convert, ChecksItsOutputFirst) {
  makeRig();
  // The source does not exist either, so these errors are found before reading.
  EXPECT_TRUE(fails("convert nothing.obj -o no/face.sweep", "there is no folder no"));
  EXPECT_TRUE(fails("convert nothing.obj -o targets", "it is a folder"));
  EXPECT_TRUE(fails("convert nothing.obj -o targets/jawOpen.obj", "must end in"));
  EXPECT_TRUE(fails("convert neutral.obj targets -o neutral.obj", "it is what is read"));
  EXPECT_EQ(contents(folder / "neutral.obj"), sheet());
}

TEST_F(Convert, StopsOnInterrupt) {
  folder.file("face.sweep", "old");
  // The tool has opened the pipe once opening it here returns, and waits for a mesh that never
  // comes.
  const std::filesystem::path pipe = folder / "neutral.obj", output = folder / "face.sweep";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const pid_t child = start({"convert", pipe.string(), "-o", output.string()});
  ASSERT_GE(child, 0);
  const int writer = open(pipe.c_str(), O_WRONLY);
  ASSERT_GE(writer, 0);
  kill(child, SIGINT);
  close(writer);
  EXPECT_EQ(codeOf(child), 130);
  EXPECT_EQ(contents(folder / ".err"), "sweepface: Interrupted; nothing was written.\n");
  EXPECT_EQ(contents(output), "old");
}

}  // namespace
}  // namespace sweepface
