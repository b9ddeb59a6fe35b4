#include <cmath>
#include <fmt/format.h>
#include <sstream>

#include "sweepface/trajectory.hpp"

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
  EXPECT_GT(points("500 --damping 0.01"), 5 * points("2 --damping 0.01"));
}

/// The points of the first panel's curve, whose axes go from (0, 0) to (seconds, highest).
std::vector<Vec2> positionsIn(const std::string& svg, double seconds, double highest) {
  std::istringstream points(svg.substr(svg.find("points=\"") + 8));
  std::vector<Vec2> way;
  char comma = 0;
  for (double x = 0, y = 0; points >> x >> comma >> y;)
    way.push_back({(x - 70) / (462 - 70) * seconds, (278 - y) / (278 - 52) * highest});
  return way;
}

TEST_F(Plot, FollowsABounceHoweverLively) {
  convertRig();
  for (const double e : {0.4, 0.9, 0.98}) {
    const auto way = positionsIn(
        plotted(fmt::format("--to jawOpen=1 --law bounce --restitution {} --seconds 2", e)), 2, 1);
    ASSERT_GT(way.size(), 240u);
    const double fall = 2 * (1 - e) / (1 + e);
    const auto law = Trajectory::bounce({0, 0}, 1, fall, e).value();
    const auto drawn = [&](double time) {
      const auto after = std::ranges::lower_bound(way, time, {}, &Vec2::x);
      const Vec2 b = *after, a = after == way.begin() ? b : *(after - 1);
      return b.x > a.x ? std::lerp(a.y, b.y, (time - a.x) / (b.x - a.x)) : b.y;
    };
    // A pixel is 1/200 s, in which the liveliest bounce goes a quarter of its way.
    double worst = 0;
    for (double time = 0.001; time < 1.99; time += 0.0037) {
      double miss = 1;
      for (double near = -0.004; near <= 0.004; near += 0.0001)
        miss = std::min(miss, std::abs(drawn(time) - law.at(time + near).position));
      worst = std::max(worst, miss);
    }
    EXPECT_LE(worst, 0.01) << e;
  }
}

// A bounce is at rest in the end. That would draw a line down the edge of the picture, or none,
// depending on how the time rounds.
TEST_F(Plot, EndsABounceInTheAir) {
  convertRig();
  for (const char* seconds : {"0.7", "1", "3"}) {
    const std::string svg =
        plotted(fmt::format("--to jawOpen=1 --law bounce --seconds {}", seconds));
    const auto way = positionsIn(svg.substr(svg.find(">Acceleration<")), 1, 1);
    ASSERT_GT(way.size(), 240u);
    EXPECT_EQ(way.back().y, way.front().y) << seconds;
  }
}

// The speed after a hit is e of the speed before: the curve's lowest points.
TEST_F(Plot, ShowsHowFastABounceComesBack) {
  convertRig();
  const double e = 0.9, seconds = 2, fall = seconds * (1 - e) / (1 + e);
  std::string svg = plotted("--to jawOpen=1 --law bounce --restitution 0.9 --seconds 2");
  svg = svg.substr(svg.find(">Velocity<"));
  // The axis: from its lowest tick, at the bottom, to its highest.
  std::vector<double> ticks;
  constexpr std::string_view end = "text-anchor=\"end\"";
  for (std::size_t at = svg.find(end); at < svg.find("<polyline"); at = svg.find(end, at + 1))
    ticks.push_back(std::stod(svg.substr(svg.find('>', at) + 1)));
  const auto way = positionsIn(svg, seconds, 1);
  double hit = fall;
  for (int n = 1; n < 20; hit += 2 * fall * std::pow(e, n++)) {
    double lowest = 0;
    for (const Vec2& p : way)
      if (std::abs(p.x - hit) < 0.2 * fall * std::pow(e, n))
        lowest = std::min(lowest, std::lerp(ticks.front(), ticks.back(), p.y));
    EXPECT_NEAR(lowest, -2 / fall * std::pow(e, n), 0.1) << n;
  }
}

TEST_F(Plot, TellsColoursThatComeAgainByDashes) {
  convertRig();
  std::string many = "3";
  for (int k = 0; k < 8; ++k) many += "," + std::to_string(k + 4);
  EXPECT_EQ(countOf(plotted("--to jawOpen=1 --vertex 3"), "stroke-dasharray"), 0u);
  EXPECT_EQ(countOf(plotted("--to jawOpen=1 --vertex " + many), "stroke-dasharray"), 4u * 2);
}

TEST_F(Plot, SaysWhereCurvesLookTheSame) {
  convertRig();
  std::string many = "0";
  for (int k = 1; k < 33; ++k) many += "," + std::to_string(k);
  const Outcome r = run("plot face.sweep -o plot.svg --to jawOpen=1 --vertex " + many);
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("33 curves are more than the 32 colours"), std::string::npos) << r.err;
}

TEST_F(Plot, SaysWhatAClipDoesNotDrive) {
  convertRig();
  std::ofstream(folder / "take.csv") << "Timecode,JawOpen,Jawbone\n0,0,0\n0.5,1,1\n1,0,0\n";
  const Outcome r = run("plot face.sweep -o plot.svg --clip take.csv");
  EXPECT_NE(r.err.find("1 of 2 names drive no target of the face: Jawbone"), std::string::npos)
      << r.err;
  EXPECT_NE(r.out.find("plot.svg: 1 curve\n"), std::string::npos) << r.out;
}

// Nothing is known about what comes before and after a clip.
TEST_F(Plot, ClipsEndInMotion) {
  convertRig();
  ASSERT_EQ(run("animate face.sweep --to jawOpen=1 -o take.csv --quiet").code, 0);
  ASSERT_EQ(run("plot face.sweep --to jawOpen=1 -o law.svg --quiet").code, 0);
  ASSERT_EQ(run("plot face.sweep --clip take.csv --weight jawOpen -o clip.svg --quiet").code, 0);
  for (const std::string plot : {"law.svg", "clip.svg"})
    EXPECT_EQ(contents(folder / plot).find(">-"), std::string::npos) << "nothing is below 0";
}

TEST_F(Plot, APartOfAClipBeginsAtNought) {
  convertRig();
  std::ofstream(folder / "take.csv") << "Timecode,JawOpen\n0,0\n2,0\n3,1\n";
  const auto way = positionsIn(plotted("--clip take.csv --clip-from 2"), 1, 1);
  ASSERT_GT(way.size(), 200u);
  EXPECT_NEAR(way.front().x, 0, 0.01);
  EXPECT_NEAR(way.back().x, 1, 0.01);
  for (const Vec2& p : way) EXPECT_NEAR(p.y, p.x, 0.01);
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
  for (const std::string much : {"--mass 1e308 --seconds 0.001", "--mass 1e300"})
    refused("-o plot.svg --to jawOpen=1 " + much, "beyond what numbers hold");
  refused("-o plot.svg --to jawOpen=1 --law spring --frequency 1e5 --damping 1e-9",
          "more than a plot can show");
  refused("-o plot.svg --to jawOpen=1 --law bounce --restitution 0.9999999",
          "more than a plot can show");
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
  // A vertex of the region moves as if the whole face did so.
  folder.file("everywhere.json", R"({"seconds": 1,
    "events": [{"at": 0, "to": {"smile": 0.25, "jawOpen": 1}}]})");
  EXPECT_EQ(plotted("--clip line.json --vertex 6"), plotted("--clip everywhere.json --vertex 6"));
  EXPECT_NE(plotted("--clip line.json --vertex 0"), plotted("--clip everywhere.json --vertex 0"));
}

TEST_F(Plot, LawsNeedNoFace) {
  EXPECT_EQ(run("laws -o laws.svg").out, "laws.svg: 10 laws\n");
  EXPECT_EQ(run("laws -o laws.svg --quiet").out, "");
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
