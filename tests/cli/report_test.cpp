#include <nlohmann/json.hpp>
#include <sstream>

#include "sweepface/codec.hpp"
#include "sweepface/measure.hpp"

#include "cli/tool.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace testing;
using nlohmann::json;
using Info = Tool;
using Check = Tool;
using Measure = Tool;
using Usage = Tool;

TEST_F(Info, CountsWhatIsThere) {
  convertRig();
  const Outcome r = run("info face.sweep --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json info = json::parse(r.out);
  EXPECT_EQ(info["quads"], 30);
  EXPECT_EQ(info["vertices"], 42);
  EXPECT_EQ(info["targets"], (std::vector<std::string>{"jawOpen", "smile"}));
  EXPECT_EQ(info["tolerance"], 0.01);
  EXPECT_GE(info["patches"], 1);
  EXPECT_EQ(info["nodes"], info["fullNodes"].get<int>() + info["irregularNodes"].get<int>() +
                               info["hangingNodes"].get<int>());
  EXPECT_GE(info["arcs"], 4);
  EXPECT_GE(info["vectors"], 4);
}

TEST_F(Info, ItsPartsMakeUpTheFile) {
  convertRig();
  const json info = json::parse(run("info face.sweep --json").out);
  std::size_t sum = 0;
  for (const auto& [part, bytes] : info["parts"].items()) sum += bytes.get<std::size_t>();
  EXPECT_EQ(sum, contents(folder / "face.sweep").size());
  EXPECT_EQ(info["bytes"], sum);
}

TEST_F(Info, IsReadableByPeople) {
  convertRig();
  const Outcome r = run("info face.sweep");
  EXPECT_EQ(r.code, 0);
  for (const std::string part :
       {"over 30 quads", "2: jawOpen, smile", "42 vertices", "tolerance  0.01"})
    EXPECT_NE(r.out.find(part), std::string::npos) << part << "\n" << r.out;
  EXPECT_EQ(run("info face.sweep --quiet").out, "");
}

// U+009B begins commands of terminals, like the escape character.
TEST_F(Info, KeepsControlCharactersOfNamesFromTheTerminal) {
  makeRig();
  folder.file("targets/a\xC2\x9B.obj", sheet());
  ASSERT_EQ(run("convert neutral.obj targets -o face.sweep -q").code, 0);
  for (const char* command : {"info face.sweep", "measure face.sweep neutral.obj targets"}) {
    const Outcome r = run(command);
    EXPECT_NE(r.out.find("a?"), std::string::npos) << r.out;
    EXPECT_EQ(r.out.find("\xC2\x9B"), std::string::npos) << command;
  }
}

TEST_F(Info, RefusesWhatIsNoFace) {
  EXPECT_TRUE(fails("info face.sweep", "face.sweep: there is no such file"));
  folder.file("face.sweep", "not a face");
  EXPECT_TRUE(fails("info face.sweep", "face.sweep"));
  EXPECT_TRUE(fails("info .", "it is a folder"));
}

TEST_F(Check, FindsAFreshFaceSound) {
  folder.file("cube.obj", cube(3));
  ASSERT_EQ(run("convert cube.obj -o face.sweep --tolerance 0.2").code, 0);
  const Outcome r = run("check face.sweep --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json report = json::parse(r.out);
  EXPECT_EQ(report["sound"], true);
  EXPECT_TRUE(report["problems"].empty());
  EXPECT_EQ(report["irregularNodes"], 8);
  EXPECT_EQ(report["joins"]["boundary"]["count"], 0);
  EXPECT_GT(report["joins"]["spoke"]["count"], 0);
  double share = 0;
  for (const json& join : report["joins"]) share += join["lengthShare"].get<double>();
  EXPECT_NEAR(share, 1, 1e-12);
  for (const std::string kind : {"C2", "spoke"})
    EXPECT_LE(report["joins"][kind]["positionGap"], 1e-12) << kind;
}

TEST_F(Check, LooksAtEveryPose) {
  convertRig();
  const Outcome r = run("check face.sweep");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("face.sweep: sound\n"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("4 poses: the neutral, 2 targets and a mixture"), std::string::npos)
      << r.out;
  EXPECT_EQ(run("check face.sweep --quiet").out, "");
}

TEST_F(Check, KnowsHowFarAPoseIsFromTheOrigin) {
  folder.file("neutral.obj", sheet());
  folder.file("far.obj", sheet([](Vec3 p) { return p + Vec3{1e6, 0, 0}; }));
  ASSERT_EQ(run("convert neutral.obj far.obj -o face.sweep --tolerance 0.05").code, 0);
  EXPECT_EQ(run("check face.sweep").code, 0);
}

TEST_F(Check, FailsForNumbersBeyondReckoning) {
  Rig rig;
  rig.surface = Surface::make(onePatch(2, 2)).value();
  rig.neutral.resize(rig.surface.storedCount(), {1, 2, 3});
  rig.neutral[3] = {1e300, 1, 1};
  folder.file("far.sweep", encode(rig));
  const Outcome r = run("check far.sweep");
  EXPECT_EQ(r.code, 1) << r.out;
  EXPECT_NE(r.err.find("beyond single precision"), std::string::npos) << r.out << r.err;
}

TEST_F(Check, FailsForASceneThatDoesNotFit) {
  Rig rig;
  rig.surface = Surface::make(onePatch(2, 2)).value();
  rig.neutral.resize(rig.surface.storedCount(), {1, 2, 3});
  for (const std::string scene : {"glTF", "{\"asset\": {\"version\": \"2.0\"}}"}) {
    rig.scene = scene;
    folder.file("odd.sweep", encode(rig));
    EXPECT_TRUE(
        fails("check odd.sweep -q", "odd.sweep is broken: The face and its scene do not fit"));
  }
}

TEST_F(Check, RefusesADamagedFile) {
  convertRig();
  std::string bytes = contents(folder / "face.sweep");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
  folder.file("damaged.sweep", bytes);
  EXPECT_TRUE(fails("check damaged.sweep", "damaged.sweep"));
  folder.file("short.sweep", bytes.substr(0, bytes.size() / 3));
  EXPECT_TRUE(fails("check short.sweep", "short.sweep"));
}

TEST_F(Measure, ComparesEveryShapeAndMixture) {
  convertRig();
  const Outcome r = run("measure face.sweep neutral.obj targets --mixtures 3 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json report = json::parse(r.out);
  ASSERT_EQ(report["shapes"].size(), 3u);
  EXPECT_EQ(report["shapes"][1]["name"], "jawOpen");
  EXPECT_EQ(report["mixtures"].size(), 3u);
  for (const json& row : report["shapes"]) {
    EXPECT_LE(row["distanceMax"], 0.01);
    EXPECT_LE(row["distanceRms"], row["distanceMax"]);
    EXPECT_LE(row["distanceMax"], report["worst"]["distanceMax"]);
    EXPECT_LE(row["displacementMax"], report["worst"]["displacementMax"]);
    EXPECT_LE(row["displacement999"], row["displacementMax"]);
    EXPECT_LE(row["angle99"], row["angle999"]);
  }
  EXPECT_EQ(report["shapes"][0]["displacementMax"], 0);
  EXPECT_GT(report["worst"]["displacementRms"], 0);
  EXPECT_GT(report["worst"]["angle99"], 0);
  const std::vector<std::filesystem::path> targets{folder / "targets"};
  const Measurement own = measure(decode(contents(folder / "face.sweep"), "face.sweep").value(),
                                  readRig(folder / "neutral.obj", targets).value(), {3})
                              .value();
  for (std::size_t k = 0; k < own.shapes.size(); ++k) {
    const PoseErrors& e = own.shapes[k];
    const json& row = report["shapes"][k];
    EXPECT_EQ(row["name"], e.name);
    EXPECT_EQ(row["angleMax"], e.angle.max);
    EXPECT_EQ(row["shadingRms"], e.shadingRms);
    EXPECT_EQ(row["facetDistance"], e.facetDistance);
    EXPECT_EQ(row["facetExcess"], e.facetExcess);
    EXPECT_EQ(row["folds"], e.folds);
  }
}

TEST_F(Measure, PrintsARowAShape) {
  convertRig();
  const Outcome r = run("measure face.sweep neutral.obj targets --mixtures 2");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 2 + 3 + 1 + 2 + 1) << r.out;
  for (const std::string name :
       {"\njawOpen ", "\nsmile ", "\nworst ", " 99 % ", "\ndisplacements "})
    EXPECT_NE(r.out.find(name), std::string::npos) << name << r.out;
}

TEST_F(Measure, DrawsTheMixturesOfASeed) {
  convertRig();
  const std::string command = "measure face.sweep neutral.obj targets --mixtures 1 --seed ";
  EXPECT_EQ(run(command + "5").out, run(command + "5").out);
  EXPECT_NE(run(command + "5").out, run(command + "6").out);
}

TEST_F(Measure, SaysThatMeshesAreHardlyTheFaces) {
  convertRig();
  EXPECT_EQ(run("measure face.sweep neutral.obj targets --mixtures 0").err, "");
  folder.file("other/jawOpen.obj", sheet(smiling));
  const Outcome r = run("measure face.sweep neutral.obj other --mixtures 0 -q");
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(r.err.starts_with("sweepface: warning: jawOpen is up to ")) << r.err;
}

TEST_F(Measure, SaysWhichTargetsWereLeftOut) {
  convertRig();
  const Outcome r = run("measure face.sweep neutral.obj targets/smile.obj --mixtures 0");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err,
            "sweepface: warning: 1 of the 2 targets of the face was not compared, as no mesh is "
            "named like it: 'jawOpen'.\n");
  EXPECT_NE(
      run("measure face.sweep neutral.obj --mixtures 0")
          .err.find(
              "2 of the 2 targets of the face were not compared, as no mesh is named like them: "
              "'jawOpen' and others."),
      std::string::npos);
}

TEST_F(Measure, RefusesForeignMeshes) {
  convertRig();
  folder.file("cube.obj", cube(2));
  folder.file("other.obj", sheet(opened));
  EXPECT_EQ(run("measure face.sweep cube.obj").code, 1);
  EXPECT_TRUE(fails("measure face.sweep neutral.obj other.obj",
                    "face.sweep: the model has no target named 'other'; give the targets it was "
                    "converted from.\n"));
  EXPECT_TRUE(fails("measure face.sweep nothing.obj", "nothing.obj"));
  EXPECT_TRUE(fails("measure face.sweep neutral.obj --mixtures -1", "--mixtures", 2));
}

TEST_F(Usage, TakesFacesThatDoNotKnowTheirQuads) {
  convertRig();
  auto rig = decode(contents(folder / "face.sweep"), "face.sweep");
  ASSERT_TRUE(rig.has_value());
  rig->source.quadCorners.clear();
  folder.file("bare.sweep", encode(*rig));
  folder.file("part.json", R"({"regions": [{"name": "a", "parts": ["skin"]}]})");
  folder.file("point.json", R"({"regions": [{"name": "a", "points": [[3, 3, 0]], "fade": 2}]})");
  for (const std::string command :
       {"info bare.sweep", "check bare.sweep", "export bare.sweep -o out.obj",
        "export bare.sweep -o out.glb --lod 2", "render bare.sweep -o out.png --size 100x100",
        "render bare.sweep -o out.png --size 100x100 --style error --compare neutral.obj",
        "wireframe bare.sweep -o out.wire.json", "wireframe bare.sweep -o wires.obj",
        "build out.wire.json -o built.sweep", "report bare.sweep -o motion.html",
        "animate bare.sweep --to smile=1 -o moved.glb",
        "animate bare.sweep --to jawOpen=1 --arcs on -o arcs.glb",
        "animate bare.sweep --to smile=1 --law spring --regions point.json -o part.glb",
        "edit bare.sweep -o edited.sweep --move n0 0,0,0.1",
        "plot bare.sweep --to smile=1 -o plot.svg"}) {
    const Outcome r = run(command);
    EXPECT_EQ(r.code, 0) << command << ": " << r.err;
  }
  for (const std::string command : {"measure bare.sweep neutral.obj targets",
                                    "report bare.sweep neutral.obj targets -o a.html -q"})
    EXPECT_TRUE(fails(command, "bare.sweep: the face does not tell which of its source's polygons"))
        << command;
  EXPECT_TRUE(fails("animate bare.sweep --to smile=1 --law spring --regions part.json -o part.glb",
                    "does not tell of its source's materials"));
}

TEST_F(Usage, EveryCommandHelps) {
  std::istringstream help(run("help").out);
  std::string line;
  while (line != "Subcommands:") ASSERT_TRUE(std::getline(help, line));
  int commands = 0;
  for (; std::getline(help, line) && line.starts_with("  "); ++commands) {
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    const Outcome r = run(command + " --help");
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.out.find("  sweepface " + command), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("--quiet"), std::string::npos) << r.out;
    EXPECT_NE(run("--help").out.find("  " + command), std::string::npos);
    EXPECT_TRUE(fails(command, "is required\nTry `sweepface " + command + " --help`", 2));
  }
  EXPECT_GE(commands, 14);
}

TEST_F(Usage, HasAVersion) {
  const Outcome r = run("--version");
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(r.out.starts_with("sweepface ")) << r.out;
}

TEST_F(Usage, RefusesWhatItDoesNotKnow) {
  EXPECT_TRUE(fails("", "A command is required", 2));
  EXPECT_TRUE(fails("info face.sweep --loud", "--loud", 2));
  EXPECT_NE(run("help convert").out.find("sweepface convert"), std::string::npos);
  EXPECT_NE(run("help").out.find("convert"), std::string::npos);
  EXPECT_TRUE(fails("help nothing", "There is no command 'nothing'.", 2));
  EXPECT_TRUE(fails("dance --quickly", "There is no command 'dance'", 2));
}

TEST_F(Usage, DoesNotMixTheReportWithWhatItMakes) {
  convertRig();
  const auto exportTo = [&](const std::string& output) {
    const std::string command =
        fmt::format("cd '{}' && '{}' export face.sweep -o {} 2>.err | cat >.out",
                    (folder / "").string(), SWEEPFACE_TOOL, output);
    EXPECT_EQ(std::system(command.c_str()), 0);  // the exit code of cat
    return contents(folder / ".out");
  };
  EXPECT_EQ(exportTo("/dev/stdout"), "");
  EXPECT_NE(contents(folder / ".err").find("the report goes there"), std::string::npos);
  exportTo("face.obj");
  EXPECT_EQ(exportTo("/dev/stdout --quiet"), contents(folder / "face.obj"));
}

TEST_F(Usage, NoticesThatNobodyCanReadTheReport) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  convertRig();
  // A short report fails at its end, a long one on the way.
  for (const char* arguments : {"--help", "info face.sweep", "check face.sweep",
                                "measure face.sweep neutral.obj targets --mixtures 100"}) {
    const std::string command = fmt::format("cd '{}' && '{}' {} >/dev/full 2>.err",
                                            (folder / "").string(), SWEEPFACE_TOOL, arguments);
    EXPECT_NE(std::system(command.c_str()), 0);
    EXPECT_EQ(contents(folder / ".err"),
              "sweepface: Cannot write the report: the output is full or closed.\n");
  }
}

TEST_F(Usage, GoesOnWhereNobodyHearsWhatIsWrong) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  for (const char* stream : {"2>/dev/full", "2>&-"}) {
    const std::string command =
        fmt::format("'{}' info '{}' {}", SWEEPFACE_TOOL, (folder / "none.sweep").string(), stream);
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1) << stream;
  }
}

TEST_F(Usage, ListsEndWhereTheFaceBegins) {
  convertRig();
  for (const char* arguments :
       {"plot --laws linear,newton face.sweep --to smile=1 -o a.svg",
        "plot --weight smile face.sweep --to smile=1 -o a.svg",
        "plot --vertex 3,5 face.sweep --to smile=1 -o a.svg",
        "render --law newton,linear --box smile face.sweep --to smile=1 -o a.png --frames 2",
        "edit --move n0 0,0,0.1 --move n1 0,0,0.1 face.sweep -o other.sweep"}) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, 0) << arguments << r.err;
  }
  EXPECT_TRUE(fails("report --box smile face.sweep --weights frown=1 -o a.html", "frown"));
}

// A pipe can be read once; a report that has read it goes on to the meshes.
TEST_F(Usage, ReadsAFaceFromAPipe) {
  convertRig();
  const auto succeeds = [&](const char* command) {
    return std::system(fmt::format("cd '{}' && cat face.sweep | '{}' {} >.out 2>.err",
                                   (folder / "").string(), SWEEPFACE_TOOL, command)
                           .c_str()) == 0;
  };
  EXPECT_TRUE(succeeds("info /dev/stdin"));
  EXPECT_FALSE(succeeds("report /dev/stdin nothing.obj -o page.html"));
  EXPECT_NE(contents(folder / ".err").find("Cannot read nothing.obj"), std::string::npos);
}

TEST_F(Usage, LeavesNothingOfAReportOnInterrupt) {
  convertRig();
  const auto at = [&](const char* name) { return (folder / name).string(); };
  folder.file("temporary/.keep", "");
  folder.file("pack", "#!/bin/sh\necho >> " + at("runs") + "\nsleep 1\ncp \"$2\" \"$4\"\n");
  std::filesystem::permissions(at("pack"), std::filesystem::perms::owner_all);
  setenv("TMPDIR", at("temporary").c_str(), 1);
  const pid_t child = start({"report", at("face.sweep"), at("neutral.obj"), at("targets"),
                             "--tolerances", "0.5", "--gltfpack", at("pack"), "-o", at("a.html")});
  unsetenv("TMPDIR");
  ASSERT_GE(child, 0);
  while (!std::filesystem::exists(at("runs")) && waitpid(child, nullptr, WNOHANG) == 0)
    usleep(1000);
  usleep(100'000);  // a thread that is still starting a program gets no signal
  kill(child, SIGINT);
  EXPECT_EQ(codeOf(child), 130);
  EXPECT_EQ(contents(at(".err")), "sweepface: Interrupted; nothing was written.\n");
  EXPECT_EQ(contents(at("runs")), "\n");
  EXPECT_FALSE(std::filesystem::exists(at("a.html")));
  for (const auto& left : std::filesystem::directory_iterator(at("temporary")))
    EXPECT_EQ(left.path().filename(), ".keep");
}

// As CLI11 would by default.
TEST_F(Usage, DoesNotTakeALeadingZeroForOctal) {
  convertRig();
  ASSERT_EQ(run("export face.sweep -o a.obj --lod 010").code, 0);
  ASSERT_EQ(run("export face.sweep -o b.obj --lod 10").code, 0);
  EXPECT_TRUE(contents(folder / "a.obj") == contents(folder / "b.obj"));
}

}  // namespace
}  // namespace sweepface
