#include <numbers>

#include "cli/tool.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Following : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    std::filesystem::create_directory(folder / "turns");
  }
  /// Converts meshes to face.sweep; each expression is the neutral changed by its function.
  void convertWith(const std::map<std::string, std::function<Vec3(const Vec3&)>>& expressions) {
    EXPECT_TRUE(writeFile(folder / "neutral.obj", sheet()));
    for (const auto& [name, place] : expressions)
      EXPECT_TRUE(writeFile(folder / "turns" / (name + ".obj"), sheet(place)));
    const Outcome r = run("convert neutral.obj turns -o face.sweep --tolerance 0.001 --quiet");
    ASSERT_EQ(r.code, 0) << r.err;
  }
  std::vector<Vec3> exported(const std::string& options) {
    const Outcome r = run("export face.sweep -o out.obj " + options);
    EXPECT_EQ(r.code, 0) << r.err;
    return mesh("out.obj").positions;
  }
};

constexpr double kHinge = -30;

Vec3 turnedAboutX(const Vec3& p, double degrees) {
  const double a = degrees * std::numbers::pi / 180, z = p.z - kHinge;
  return {p.x, std::cos(a) * p.y - std::sin(a) * z, kHinge + std::sin(a) * p.y + std::cos(a) * z};
}

double furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.size(); ++v) worst = std::max(worst, norm(a[v] - b[v]));
  return worst;
}

TEST_F(Following, ArcsTurnWhatTurns) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 30); }}});
  std::vector<Vec3> half = exported("");
  for (Vec3& p : half) p = turnedAboutX(p, 15);
  EXPECT_LE(furthest(exported("--weights jawOpen=0.5 --arcs on"), half), 0.01);
  EXPECT_GE(furthest(exported("--weights jawOpen=0.5 --arcs off"), half), 0.5);
  EXPECT_EQ(exported("--weights jawOpen=1 --arcs on"), exported("--weights jawOpen=1"));
}

TEST_F(Following, TellsWhereArcsChangeNothing) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 30); }},
               {"shift", [](const Vec3& p) { return p + Vec3{0, 1, 0}; }}});
  const auto warning = [&](const std::string& weights) {
    return run("export face.sweep -o mesh.obj --arcs on --weights " + weights).err;
  };
  EXPECT_EQ(warning("shift=1"),
            "sweepface: warning: No target of the expression turns about anything, so --arcs "
            "changes nothing; those that turn are jawOpen.\n");
  EXPECT_EQ(warning("shift=1,jawOpen=0.5"), "");
  EXPECT_EQ(warning("shift=1 --limits jawOpen=0.5:1"), "");
  EXPECT_EQ(run("export face.sweep -o face.glb --arcs on").err, "");
}

TEST_F(Following, FilesRecordWhatTurns) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 30); }},
               {"shift", [](const Vec3& p) { return p + Vec3{0, 1, 0}; }}});
  EXPECT_EQ(run("info face.sweep").out.find("turns"), std::string::npos);
  const std::string convert = "convert neutral.obj turns -o turns.sweep --arcs";
  ASSERT_EQ(run(convert).code, 0);
  EXPECT_NE(run("info turns.sweep").out.find("turns      1: jawOpen\n"), std::string::npos);
  EXPECT_TRUE(fails(convert + " on", "Here --arcs stands alone; leave 'on' out."));
}

TEST_F(Following, AnimationsTakeArcsAlong) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 30); }}});
  ASSERT_EQ(
      run("animate face.sweep --to jawOpen=1 --law linear --frames 3 --arcs on -o frames").code, 0);
  EXPECT_EQ(mesh("frames/frame_0001.obj").positions, exported("--weights jawOpen=0.5 --arcs on"));
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 --arcs on -o jaw.glb").code, 0);
  const std::string glb = contents(folder / "jaw.glb");
  EXPECT_NE(glb.find(R"("targetNames":["jawOpen","jawOpen.arc"])"), std::string::npos);
  const Outcome r = run("animate face.sweep --to jawOpen=1 --arcs on --keys exact -o jaw.glb");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("cannot hold newton exactly"), std::string::npos) << r.err;
}

/// A face.sweep of two eyeballs in front of a plane; eyeLookDownLeft turns the left one.
class Eyeballs : public Following {
 protected:
  void SetUp() override {
    Following::SetUp();
    const Vec3 left{3, 4, -1}, right{-3, 4, -1};
    PolygonMesh neutral = joined(plane(), cubeSphere(6, 1.5), left);
    const std::size_t end = neutral.positions.size();
    neutral = joined(neutral, cubeSphere(6, 1.5), right);
    PolygonMesh looking = neutral;
    for (std::size_t v = plane().positions.size(); v < end; ++v) {
      const Vec3 arm = neutral.positions[v] - left;
      looking.positions[v] = left + turnedAboutX(arm + Vec3{0, 0, kHinge}, 30) - Vec3{0, 0, kHinge};
    }
    EXPECT_TRUE(
        writeFile(folder / "neutral.obj", formatObj({neutral.positions, {}, neutral.polygons})));
    EXPECT_TRUE(writeFile(folder / "turns/eyeLookDownLeft.obj",
                          formatObj({looking.positions, {}, looking.polygons})));
    ASSERT_EQ(run("convert neutral.obj turns -o face.sweep --tolerance 0.001 --quiet").code, 0);
  }
};

/// Eyes that turn take over all the motion of a target, which leaves no arc to it.
TEST_F(Eyeballs, LeaveNoEmptyArcs) {
  const auto hasArc = [&](const std::string& options) {
    EXPECT_EQ(run("export face.sweep -o out.glb " + options).code, 0);
    return contents(folder / "out.glb").find("eyeLookDownLeft.arc") != std::string::npos;
  };
  EXPECT_TRUE(hasArc("--arcs on"));
  EXPECT_FALSE(hasArc("--arcs on --eyes on"));
  // Its own output is no source for it.
  ASSERT_EQ(run("convert out.glb -o again.sweep --tolerance 0.001 --quiet").code, 0);
  const Outcome again = run("export again.sweep --eyes on -o again.glb");
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("like 'eyeLeft.down'"), std::string::npos) << again.err;
}

TEST_F(Eyeballs, AreComparedWithWhereTheirTargetsLeadStraight) {
  const auto rendered = [&](const std::string& more) {
    const Outcome r =
        run("render face.sweep -o out.png --size 300x200 --style error --combine " + more);
    EXPECT_EQ(r.code, 0) << r.err;
    return contents(folder / "out.png");
  };
  const std::string down = "--weights eyeLookDownLeft=1";
  EXPECT_EQ(rendered(down + " --eyes on"), rendered(down));
  EXPECT_NE(rendered(down), rendered(""));
}

TEST_F(Following, CombinedTargetsFollow) {
  const auto along = [](Vec3 by) { return [by](const Vec3& p) { return p + by; }; };
  convertWith({{"A", along({1, 0, 0})},
               {"B", along({0, 1, 0})},
               {"A_B", along({0, 0, 4})},
               {"B_50", along({0, 2, 0})}});
  const std::vector<Vec3> rest = exported("");
  const auto shift = [&](const std::string& options) { return exported(options)[7] - rest[7]; };
  EXPECT_LE(norm(shift("--weights A=0.5,B=1 --combine") - Vec3{0.5, 1, 2}), 0.01);
  EXPECT_LE(norm(shift("--weights B=0.5 --combine") - Vec3{0, 2, 0}), 0.01);
  EXPECT_LE(norm(shift("--weights A=0.5,B=1") - Vec3{0.5, 1, 0}), 0.01);
}

TEST_F(Following, SaysWhatCountsForNothing) {
  convertWith({{"A", [](const Vec3& p) { return p + Vec3{1, 0, 0}; }},
               {"B", [](const Vec3& p) { return p + Vec3{0, 1, 0}; }},
               {"A_B", [](const Vec3& p) { return p + Vec3{0, 0, 4}; }}});
  const std::string warning = "--combine: A_B follows A and B, so that its own weight counts for";
  for (const std::string command : {"export face.sweep -o out.obj --weights A_B=1 ",
                                    "render face.sweep -o out.png --weights A_B=1 ",
                                    "animate face.sweep -o out.glb --from A_B=1 --to A=1 "}) {
    EXPECT_TRUE(run(command + "--combine").err.contains(warning)) << command;
    EXPECT_FALSE(run(command).err.contains(warning)) << command;
  }
  EXPECT_EQ(run("export face.sweep -o out.obj --weights A=1 --combine").err, "");
}

TEST_F(Following, SaysWhatWouldCombineIfItWereSpeltAlike) {
  const auto moved = [](const Vec3& p) { return p + Vec3{1, 0, 0}; };
  convertWith({{"smile", moved},
               {"jawOpen", moved},
               {"smile_jawopen", moved},
               {"smile-50", moved},
               {"smile_ib50", moved},
               {"jawOpen+smile", moved},
               {"fixOf_jawOpen_smile", moved},
               {"smileMore", moved},
               {"smile2", moved},
               {"expression1", moved},
               {"expression10", moved},
               {"expression1_jaw2", moved},
               {"smile_jawOpen", moved}});
  const std::string said = run("export face.sweep -o out.obj --combine").err;
  EXPECT_TRUE(
      said.contains("--combine: smile_jawopen does not follow jawOpen and smile, as it is") ||
      said.contains("--combine: smile_jawopen does not follow smile and jawOpen, as it is"))
      << said;
  EXPECT_TRUE(said.contains("--combine: smile-50 does not follow smile, as it is not spelt alike"));
  EXPECT_TRUE(said.contains("--combine: smile_ib50 does not follow smile, as"));
  for (const char* name : {"jawOpen+smile", "fixOf_jawOpen_smile"})
    EXPECT_TRUE(said.contains(fmt::format("--combine: {} does not follow jawOpen and smile", name)))
        << said;
  EXPECT_EQ(std::ranges::count(said, '\n'), 5) << said;
}

TEST_F(Following, SaysWhereNothingTurnsOrIsCombined) {
  convertWith({{"A", [](const Vec3& p) { return p + Vec3{1, 0, 0}; }}});
  const Outcome arcs = run("export face.sweep -o out.obj --arcs on");
  EXPECT_EQ(arcs.code, 0);
  EXPECT_NE(arcs.err.find("No target turns about anything"), std::string::npos) << arcs.err;
  const Outcome combined = run("export face.sweep -o out.obj --combine");
  EXPECT_EQ(combined.code, 0);
  EXPECT_NE(combined.err.find("No target is named after others"), std::string::npos);
  const Outcome r = run("convert neutral.obj turns -o face.sweep --tolerance 0.001 --arcs --json");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.out.find("No target turns about anything"), std::string::npos) << r.out;
}

TEST_F(Following, ArcsAreOnOrOff) {
  const Outcome r = run("export face.sweep -o out.obj --arcs maybe");
  EXPECT_NE(r.code, 0);
  EXPECT_NE(r.err.find("--arcs"), std::string::npos) << r.err;
}

TEST_F(Following, TheFileMayTellWhatTurns) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 20); }}});
  const auto found = exported("--weights jawOpen=0.5 --arcs on");
  EXPECT_EQ(run("info face.sweep").out.find("turns"), std::string::npos);
  ASSERT_EQ(run("convert neutral.obj turns -o face.sweep --tolerance 0.001 --arcs").code, 0);
  EXPECT_NE(run("info face.sweep").out.find("turns"), std::string::npos);
  const auto told = exported("--weights jawOpen=0.5 --arcs on");
  EXPECT_LE(furthest(found, told), 1e-4);
  EXPECT_GT(furthest(told, exported("--weights jawOpen=0.5")), 0.1);
  // A round trip through text finds them again.
  ASSERT_EQ(run("wireframe face.sweep -o face.wire.json").code, 0);
  ASSERT_EQ(run("build face.wire.json -o again.sweep --source face.sweep").code, 0);
  EXPECT_NE(run("info again.sweep").out.find("turns"), std::string::npos);
  // A plain file of the same face is smaller only by the description of the turns.
  const std::size_t size = contents(folder / "face.sweep").size();
  ASSERT_EQ(run("convert neutral.obj turns -o plain.sweep --tolerance 0.001").code, 0);
  EXPECT_LE(size - contents(folder / "plain.sweep").size(), 12 + 1 + 25u);
}

TEST_F(Following, PicturesGoOnArcsAndShowWhatTheyChange) {
  convertWith({{"jawOpen", [](const Vec3& p) { return turnedAboutX(p, 30); }}});
  const auto picture = [&](const std::string& options) {
    const Outcome r = run("render face.sweep -o out.png --view side --size 160x120 " + options);
    EXPECT_EQ(r.code, 0) << r.err;
    return contents(folder / "out.png");
  };
  EXPECT_NE(picture("--weights jawOpen=0.5"), picture("--weights jawOpen=0.5 --arcs on"));
  EXPECT_EQ(picture("--weights jawOpen=1"), picture("--weights jawOpen=1 --arcs on"));
  EXPECT_NE(picture("--to jawOpen=1"), picture("--to jawOpen=1 --arcs on"));
  EXPECT_NE(picture("--weights jawOpen=0.5 --arcs on --style error"),
            picture("--weights jawOpen=1 --arcs on --style error"));
  // Limits change both sides alike.
  EXPECT_EQ(picture("--weights jawOpen=1 --limits 0:0.5 --arcs on --style error"),
            picture("--weights jawOpen=0.5 --arcs on --style error"));
  EXPECT_TRUE(
      fails("render face.sweep -o out.png --style error --arcs on --limits x", "--limits: "));
  EXPECT_TRUE(fails("export face.sweep -o out.obj --limits 0:1,jawopen=0:0.5",
                    "--limits: Did you mean 'jawOpen'? There is no target named 'jawopen'"));
  EXPECT_TRUE(fails("export face.sweep -o out.obj --limits 5:1,jawopen=0:0.5",
                    "--limits: Limits are like"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --arcs on --weights jawOpen.arc=1",
                    "no target named 'jawOpen.arc'"));
  const Outcome both = run("render face.sweep -o out.png --arcs on --compare neutral.obj");
  EXPECT_EQ(both.code, 1);
  EXPECT_NE(both.err.find("leave --compare out"), std::string::npos) << both.err;
}

}  // namespace
}  // namespace sweepface
