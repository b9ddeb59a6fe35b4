#include "cli/tool.hpp"
#include "count_of.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Plot : public Tool {
 protected:
  std::string plotted(const std::string& options) {
    const Outcome r = run("plot face.sweep -o plot.svg " + options);
    EXPECT_EQ(r.code, 0) << r.err;
    return contents(folder / "plot.svg");
  }
};

TEST_F(Plot, ShowsFourPanelsWithACurveForEveryLaw) {
  convertRig();
  const std::string svg = plotted("--to jawOpen=1 --laws linear,newton,spring");
  for (const char* panel : {"Position", "Velocity", "Acceleration", "Force"})
    EXPECT_EQ(countOf(svg, ">" + std::string(panel) + "</text>"), 1u) << panel;
  EXPECT_EQ(countOf(svg, "<polyline"), 12u);
  EXPECT_EQ(countOf(svg, ">spring</text>"), 4u);
  EXPECT_EQ(countOf(svg, "nan"), 0u);
}

TEST_F(Plot, ShowsWeightsAndVertices) {
  convertRig();
  const std::string svg = plotted("--to jawOpen=1,smile=0.5 --weight jawOpen,smile --vertex 3,12");
  for (const char* name : {"jawOpen", "smile", "vertex 3", "vertex 12"})
    EXPECT_EQ(countOf(svg, ">" + std::string(name) + "</text>"), 4u) << name;
}

TEST_F(Plot, ClipsAreShownByDifferences) {
  convertRig();
  std::ofstream(folder / "take.csv") << "Timecode,JawOpen\n0,0\n0.5,1\n1,0\n";
  EXPECT_EQ(countOf(plotted("--clip take.csv"), "<polyline"), 4u);
}

TEST_F(Plot, ShowsWhatIsShort) {
  convertRig();
  std::ofstream take(folder / "take.csv");
  take << "Timecode,JawOpen\n0,0\n10,0\n10.01,1\n10.02,0\n60,0\n";
  take.close();
  EXPECT_NE(plotted("--clip take.csv"), plotted("--clip take.csv --weight smile"));
  const auto points = [&](const std::string& frequency) {
    return countOf(plotted("--to jawOpen=1 --law spring --frequency " + frequency), ",");
  };
  EXPECT_GT(points("500"), 20 * points("2"));
}

TEST_F(Plot, SaysWhatIsWrong) {
  convertRig();
  const auto refused = [&](const std::string& options, const std::string& words) {
    const Outcome r = run("plot face.sweep " + options);
    EXPECT_EQ(r.code, 1) << options;
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "plot.svg"));
  };
  refused("-o plot.svg", "Say where to go");
  refused("-o plot.png --to jawOpen=1", "must end in .svg");
  refused("-o plot.svg --to jawOpen=1 --vertex 42", "There is no vertex 42; the face has 42");
  EXPECT_TRUE(fails("plot face.sweep -o plot.svg --to jawOpen=1 --vertex nose",
                    "--vertex: This must be a whole number", 2));
  refused("-o plot.svg --to jawOpen=1 --weight frown", "frown");
  refused("-o plot.svg --to jawOpen=1 --laws magic", "There is no law 'magic'");
  refused("-o plot.svg --to jawOpen=0", "Nothing moves");
  refused("-o plot.svg --to jawOpen=1 --mass 1e308 --seconds 0.001", "beyond what numbers hold");
  std::ofstream(folder / "take.csv") << "Timecode,JawOpen\n0,0\n0.5,1\n1,0\n";
  EXPECT_TRUE(fails("plot face.sweep -o plot.svg --clip take.csv --frequency 3",
                    "--frequency: Only spring swings", 2));
  EXPECT_TRUE(fails("plot face.sweep -o plot.svg --to jawOpen=1 --law bounce --restitution 1",
                    "from 0 to below 1", 2));
  EXPECT_EQ(run("plot face.sweep -o plot.svg --to jawOpen=1 --law bounce --restitution 0").code, 0);
}

TEST_F(Plot, ShowsWhatATimelineMeansForTheRest) {
  convertRig();
  const auto timeline = [&](const std::string& region) {
    folder.file("line.json",
                R"({"seconds": 1, "events": [{"at": 0, "to": {"smile": 1}, "region": ")" + region +
                    R"("}]})");
  };
  timeline("rest");
  EXPECT_EQ(run("plot face.sweep --clip line.json -o plot.svg").code, 0);
  timeline("cheek");
  EXPECT_TRUE(fails("plot face.sweep --clip line.json -o plot.svg", "a region 'cheek'"));
}

TEST_F(Plot, ShowsWhatEveryRegionOfATimelineDoes) {
  convertRig();
  folder.file("line.json", R"({"seconds": 1,
    "regions": [{"name": "side", "line": [[6, 0, 0], [6, 6, 0]], "whole": 1, "fade": 2,
                 "over": "space"}],
    "events": [{"at": 0, "to": {"smile": 0.25}},
               {"at": 0, "to": {"jawOpen": 1}, "region": "side"}]})");
  const std::string weights = plotted("--clip line.json --weight jawOpen");
  EXPECT_EQ(countOf(weights, "<polyline"), 4u * 2);
  EXPECT_NE(weights.find("jawOpen@rest"), std::string::npos);
  EXPECT_NE(weights.find("jawOpen@side"), std::string::npos);
  EXPECT_EQ(countOf(plotted("--clip line.json --weight jawOpen@side"), "<polyline"), 4u);
  // A vertex of the region goes as it does where the whole face moves so.
  folder.file("everywhere.json", R"({"seconds": 1,
    "events": [{"at": 0, "to": {"smile": 0.25, "jawOpen": 1}}]})");
  EXPECT_EQ(plotted("--clip line.json --vertex 6"), plotted("--clip everywhere.json --vertex 6"));
  EXPECT_NE(plotted("--clip line.json --vertex 0"), plotted("--clip everywhere.json --vertex 0"));
}

TEST_F(Plot, LawsNeedNoFace) {
  ASSERT_EQ(run("laws -o laws.svg").code, 0);
  EXPECT_TRUE(contents(folder / "laws.svg").starts_with("<svg "));
  EXPECT_TRUE(fails("laws -o laws.png", "must end in .svg"));
  EXPECT_EQ(run("laws -o /dev/null").code, 0);
}

TEST_F(Plot, ThePapersExperimentIsOneCommand) {
  convertRig();
  const Outcome r = run("report face.sweep --weights jawOpen=0.5,smile=1 -o laugh.html");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(contents(folder / "laugh.html").find("newton, frame 30: 100 %"), std::string::npos);
}

}  // namespace
}  // namespace sweepface
