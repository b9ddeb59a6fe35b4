#include <nlohmann/json.hpp>
#include <set>

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class Edit : public Tool {
 protected:
  void SetUp() override {
    const Outcome built = run(
        fmt::format("build '{}/examples/sheet.wire.json' -o sheet.sweep", SWEEPFACE_SOURCE_DIR));
    ASSERT_EQ(built.code, 0) << built.err;
  }
};

TEST_F(Edit, OfARibbonSaysWhichPatchesChanged) {
  const Outcome r = run("edit sheet.sweep --ribbon middle --eta -100 -o tight.sweep");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "tight.sweep: 3 of 9 patches changed: a1 b2, b1 c2, c1 d2\n");
  EXPECT_NE(run("info tight.sweep --list").out.find("ribbon middle: rho 1, eta -100, lambda 0.01"),
            std::string::npos);
}

TEST_F(Edit, FindsWhatIsNearAPoint) {
  const Outcome r = run("info sheet.sweep --near 1,0,2 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto near = nlohmann::json::parse(r.out)["near"];
  const auto touching = [&](const char* kind) {
    std::set<std::string> names;
    for (const auto& thing : near[kind])
      if (thing["distance"] < 1e-6) names.insert(thing["name"]);
    return names;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(touching("nodes"), Names{"b2"});
  EXPECT_EQ(touching("curves"), (Names{"a2-b2", "b2-c2", "b1-b2", "b2-b3"}));
  EXPECT_EQ(touching("patches"), (Names{"a1 b2", "b1 c2", "a2 b3", "b2 c3"}));
  EXPECT_NEAR(near["nodes"][1]["distance"], 1, 1e-6);
  for (const char* kind : {"curves", "nodes", "patches"}) EXPECT_EQ(near[kind].size(), 5u);
  for (const char* kind : {"curves", "nodes", "patches"})
    for (std::size_t k = 1; k < 5; ++k)
      EXPECT_LE(near[kind][k - 1]["distance"], near[kind][k]["distance"]);
  const std::string text = run("info sheet.sweep --near 1,0,2").out;
  EXPECT_NE(text.find("node b2: full, 0 away at 1,0,2"), std::string::npos) << text;
  EXPECT_TRUE(fails("info sheet.sweep --near ''", "--near", 2));
  EXPECT_TRUE(fails("info sheet.sweep --near 1,0", "--near is a point like 0,1.5,-2, not '1,0'"));
  for (const char* point : {"1,0,nan", "1e300,0,0"})
    EXPECT_TRUE(fails(std::string("info sheet.sweep --near ") + point, "--near is a point"));
}

TEST_F(Edit, TakesSeveralCurvesAndControlsAtOnce) {
  const Outcome r =
      run("edit sheet.sweep --move b1-c1 0,0.2,0 --move b1 0,0.3,0 --control b1-c1 'b1 c2' second "
          "0,0.1,0 --control c1-d1 'c1 d2' third 0,0.1,0 -o other.sweep");
  EXPECT_EQ(r.code, 0) << r.err;
  ASSERT_EQ(run("export sheet.sweep -o a.obj").code, 0);
  ASSERT_EQ(run("export other.sweep -o b.obj").code, 0);
  const auto before = mesh("a.obj").positions, after = mesh("b.obj").positions;
  std::set<double> heights;  // of the nodes: one goes where it is told itself
  for (std::size_t v = 0; v < before.size(); ++v)
    if (norm(before[v] - Vec3{1, before[v].y, 1}) < 1e-9 ||
        norm(before[v] - Vec3{2, before[v].y, 1}) < 1e-9)
      heights.insert(std::round((after[v].y - before[v].y) * 1e6) / 1e6);
  EXPECT_EQ(heights, (std::set<double>{0.2, 0.3}));
}

TEST_F(Edit, OfAnExpressionLeavesTheNeutralAsItIs) {
  convertRig();
  const Outcome r = run("edit face.sweep --target smile --move c1 0,0.3,0 -o other.sweep");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto exported = [&](const std::string& file, const char* weights) {
    EXPECT_EQ(run("export " + file + " -o out.obj --weights " + weights).code, 0);
    return contents(folder / "out.obj");
  };
  EXPECT_EQ(exported("other.sweep", "jawOpen=1"), exported("face.sweep", "jawOpen=1"));
  const auto smile = [&](const std::string& file) {
    exported(file, "smile=1");
    return mesh("out.obj").positions;
  };
  EXPECT_NEAR(largestDistance(smile("other.sweep"), smile("face.sweep")), 0.3, 1e-6);
}

TEST_F(Edit, MovesANodeWhereItIsToldThoughCurvesDisagree) {
  const std::string curves = "--move a1-b1 0,0,1 --move b1-c1 0,0,2", node = " --move b1 0,0,3 ";
  for (const std::string& moves : {curves + node, node + curves}) {
    const Outcome r = run("edit sheet.sweep " + moves + " -o other.sweep");
    EXPECT_EQ(r.code, 0) << r.err;
  }
}

TEST_F(Edit, ByNothingChangesNothing) {
  ASSERT_EQ(run("edit sheet.sweep --ribbon middle --eta -100 -o before.sweep").code, 0);
  for (const char* nothing :
       {"--move b1 0,0,0", "--ribbon middle --eta -100", "--control b1-c1 'b1 c2' second 0,0,0"}) {
    const Outcome r = run(fmt::format("edit before.sweep {} -o after.sweep", nothing));
    EXPECT_EQ(r.out, "after.sweep: 0 of 9 patches changed\n") << r.err;
    EXPECT_EQ(contents(folder / "after.sweep"), contents(folder / "before.sweep"));
  }
}

TEST_F(Edit, WarnsWhereAPackedFileGrows) {
  const std::string packed =
      fmt::format("'{}/tests/codec/golden_sample.sweep'", SWEEPFACE_SOURCE_DIR);
  const Outcome grown =
      run("edit " + packed + " --control c0 p0 second 0.1,0.2,0.3 -o grown.sweep");
  EXPECT_EQ(grown.code, 0) << grown.err;
  EXPECT_NE(grown.err.find("times as large"), std::string::npos) << grown.err;
  EXPECT_NE(grown.err.find("small again with sweepface pack."), std::string::npos) << grown.err;
  EXPECT_EQ(run("edit " + packed + " --move n0 0.3,0.2,0.4 -o small.sweep").err, "");
}

TEST_F(Edit, RefusesWhatItCannotDo) {
  const std::string out = " -o other.sweep";
  EXPECT_TRUE(fails("edit sheet.sweep" + out, "nothing to edit"));
  EXPECT_TRUE(fails("edit sheet.sweep --ribbon middle" + out, "needs --rho, --eta or --lambda"));
  EXPECT_TRUE(fails("edit sheet.sweep --ribbon middle --eta much" + out,
                    "--eta: This must be a number, not 'much'.", 2));
  EXPECT_TRUE(fails("edit sheet.sweep --ribbon middle --eta 1 --target other" + out,
                    "are those of all expressions"));
  EXPECT_TRUE(fails("edit sheet.sweep --ribbon belly --eta 1" + out, "'belly'"));
  EXPECT_TRUE(
      fails("edit sheet.sweep --ribbon middle --eta 1.26224375 --lambda 0.000244140625" + out,
            "cannot have these parameters"));
  EXPECT_TRUE(
      fails("edit sheet.sweep --move z9 0,0,1" + out, "There is no curve and no node named 'z9'"));
  EXPECT_TRUE(fails("edit sheet.sweep --move nose 0,0,1" + out,
                    "There is no curve and no node named 'nose'"));
  EXPECT_TRUE(
      fails("edit sheet.sweep --move n 0,0,1" + out, "There is no curve and no node named 'n'"));
  EXPECT_TRUE(fails("edit sheet.sweep --move n99 0,0,1" + out, "There is no node named 'n99'"));
  EXPECT_TRUE(fails("edit sheet.sweep --move b1 0,0" + out, "three numbers"));
  EXPECT_TRUE(fails("edit sheet.sweep --move b1 0,0,nan" + out, "three numbers"));
  EXPECT_TRUE(fails("edit sheet.sweep --control b1-c1 'b1 c2' first 0,0,1" + out, "'first'"));
  EXPECT_TRUE(fails("edit sheet.sweep --move b1 0,0,1 --target smile" + out, "'smile'"));
  EXPECT_TRUE(
      fails("edit sheet.sweep --move a1-b1 0,0,1 --move b1-c1 0,0,2" + out,
            "Two curves take node 'b1' to different places; move the node itself as well."));
  EXPECT_TRUE(fails("edit sheet.sweep --move b1 0,0,1 --move b1 1,0,0" + out,
                    "Node 'b1' is moved twice; give the sum of both."));
  EXPECT_TRUE(fails("edit sheet.sweep --move a1-b1 0,0,1 --move a1-b1 0,0,1" + out,
                    "Curve 'a1-b1' is moved twice; give the sum of both."));
  EXPECT_FALSE(std::filesystem::exists(folder / "other.sweep"));
  const std::string before = contents(folder / "sheet.sweep");
  EXPECT_TRUE(
      fails("edit sheet.sweep --ribbon middle --eta 1 -o sheet.sweep", "choose another name"));
  EXPECT_EQ(contents(folder / "sheet.sweep"), before);
}

}  // namespace
}  // namespace sweepface
