#include "sweepface/report.hpp"

#include <fmt/format.h>
#include <regex>

#include "sweepface/codec.hpp"
#include "sweepface/measure.hpp"
#include "sweepface/plot.hpp"

#include "count_of.hpp"
#include "io/temporary_folder.hpp"
#include "picture/scenes.hpp"
#include "report/colours.hpp"
#include "report/html.hpp"
#include "report/shape_study.hpp"
#include "report/words.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// Whether all tags are closed in order, except void elements such as images and links.
::testing::AssertionResult isWellFormed(std::string_view html) {
  std::vector<std::string_view> open;
  for (std::size_t at = html.find('<'); at != html.npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == html.npos) return ::testing::AssertionFailure() << "a tag does not end";
    const std::string_view tag = html.substr(at + 1, end - at - 1);
    if (tag.starts_with('!') || tag.ends_with('/') || tag.starts_with("meta") ||
        tag.starts_with("link") || tag.starts_with("img"))
      continue;
    if (!tag.starts_with('/')) {
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
      continue;
    }
    if (open.empty() || open.back() != tag.substr(1))
      return ::testing::AssertionFailure()
             << "</" << tag.substr(1) << "> where " << (open.empty() ? "nothing" : open.back())
             << " is open";
    open.pop_back();
  }
  if (!open.empty()) return ::testing::AssertionFailure() << open.back() << " stays open";
  return ::testing::AssertionSuccess();
}

/// A page without its pictures' Base64 data, which may contain any sequence of letters.
std::string withoutPictures(std::string page) {
  constexpr std::string_view start = "base64,";
  for (std::size_t at = page.find(start); at != page.npos; at = page.find(start, at + 1))
    page.erase(at + start.size(), page.find('"', at) - at - start.size());
  return page;
}

// ---- Pieces ----

TEST(Html, EscapesTexts) {
  EXPECT_EQ(html::escaped("<b>&\"x\""), "&lt;b&gt;&amp;&quot;x&quot;");
  EXPECT_EQ(html::escaped("jäwé"), "jäwé");
  EXPECT_EQ(html::escaped("m\xfcnd\x1b\n"), "m\uFFFDnd\uFFFD\n");  // Latin 1, a control character
  html::Table table({"a<b", "n"});
  table.add({"<script>", "1"}, true);
  EXPECT_EQ(table.html().find("<script>"), std::string::npos);
  EXPECT_TRUE(isWellFormed(table.html()));
  EXPECT_TRUE(isWellFormed(html::page("</title>", "<p>x</p>")));
}

TEST(Html, WritesBase64) {  // RFC 4648, section 10
  EXPECT_EQ(html::base64(""), "");
  EXPECT_EQ(html::base64("f"), "Zg==");
  EXPECT_EQ(html::base64("fo"), "Zm8=");
  EXPECT_EQ(html::base64("foo"), "Zm9v");
  EXPECT_EQ(html::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(html::base64("\xff\xfe"), "//4=");
}

TEST(Html, ShowsTheScaleOfHeatMaps) {
  const std::string scale = html::scale(0.02, "distance");
  EXPECT_NE(scale.find(html::hex(heatColour(0))), std::string::npos);
  EXPECT_NE(scale.find(html::hex(heatColour(1))), std::string::npos);
  EXPECT_NE(scale.find(">0.015<"), std::string::npos);
}

TEST(Ticks, CoverTheValuesWithReadableNumbers) {
  EXPECT_EQ(niceTicks(0, 30, false), (std::vector<double>{0, 5, 10, 15, 20, 25, 30}));
  EXPECT_EQ(niceTicks(600, 4000, true), (std::vector<double>{500, 1000, 2000, 5000}));
  EXPECT_EQ(niceTicks(2, 9e3, true), (std::vector<double>{1, 10, 100, 1000, 10000}));
  const std::vector<double> wide = niceTicks(3e-17, 0.06, true);
  EXPECT_LE(wide.size(), 8u);
  EXPECT_LE(wide.front(), 3e-17);
  EXPECT_GE(wide.back(), 0.06);
  for (const auto& [low, high] : {std::pair{0.0, 0.0199},
                                  {-3.2, 7.7},
                                  {1e-9, 3e-9},
                                  {5.0, 5.0},
                                  {0.0, 0.0},
                                  {0.3, 0.1 + 0.2},
                                  {-0.1 - 0.2, -0.3},
                                  {0.0, 1e-310}}) {
    const std::vector<double> ticks = niceTicks(low, high, false);
    ASSERT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 10u);
    EXPECT_LE(ticks.front(), low + 1e-12);
    EXPECT_GE(ticks.back(), high - 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(ticks));
  }
  for (const bool logarithmic : {false, true})
    for (const double odd : {std::nan(""), HUGE_VAL, -HUGE_VAL})
      EXPECT_GE(niceTicks(odd, 1, logarithmic).size() + niceTicks(1, odd, logarithmic).size(), 4u);
}

TEST(Plots, PutPointsWhereTheyBelong) {
  const Series rising{"rising", "#123456", {{0, 0}, {5, 50}, {10, 100}}, true};
  const std::string svg = linePlot("t", {"x"}, {"y"}, {rising});
  EXPECT_TRUE(isWellFormed(svg));
  // The legend's dot, then the three points from the lower left to the upper right corner.
  EXPECT_EQ(countOf(svg, "<circle"), 4u);
  EXPECT_NE(svg.find("points=\"70.0,278.0 266.0,165.0 462.0,52.0 \""), std::string::npos) << svg;
}

TEST(Plots, GrowWithTheirKeys) {
  const auto heightWith = [](std::size_t keys) {
    std::vector<Series> series(keys, {"a name as long as some", "#123456", {{0, 0}, {10, 100}}});
    const std::string plot = linePlot("t", {"x"}, {"y"}, series), sheet = plotSheet({plot});
    EXPECT_TRUE(isWellFormed(sheet));
    // The curve ends at the lower left and the upper right corner.
    double left = 0, bottom = 0, right = 0, top = 0, height = 0;
    const char* const points = plot.c_str() + plot.find("points=");
    EXPECT_EQ(std::sscanf(points, "points=\"%lf,%lf %lf,%lf", &left, &bottom, &right, &top), 4);
    EXPECT_GE(bottom - top, 150);
    EXPECT_EQ(std::sscanf(plot.c_str(), "<svg viewBox=\"0 0 490 %lf\"", &height), 1);
    EXPECT_GT(height, bottom);
    EXPECT_NE(sheet.find(fmt::format("width=\"490\" height=\"{}\"", height)), std::string::npos);
    return height;
  };
  EXPECT_EQ(heightWith(1), 330);
  EXPECT_EQ(heightWith(3), 330);
  EXPECT_GT(heightWith(60), 700);
}

TEST(Plots, TellTicksApart) {
  const auto labels = [](double low, double high) {
    const std::string svg = linePlot("t", {"x"}, {"y"}, {{"", "#123456", {{0, low}, {1, high}}}});
    std::vector<std::string> found;
    constexpr std::string_view end = "text-anchor=\"end\"";
    for (std::size_t at = svg.find(end); at != std::string::npos; at = svg.find(end, at + 1)) {
      const std::size_t from = svg.find('>', at) + 1;
      found.push_back(svg.substr(from, svg.find('<', from) - from));
    }
    return found;
  };
  for (const auto& [low, high] : std::initializer_list<std::pair<double, double>>{
           {1000, 1001}, {-1e6, -1e6 + 500}, {0.003947841, 0.003948841}, {0, 1}, {1e-9, 3e5}}) {
    const std::vector<std::string> all = labels(low, high);
    EXPECT_GE(all.size(), 3u);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), all.size()) << all.front();
  }
  // If values are constant up to rounding, the scale includes 0, so that they are off the axis.
  EXPECT_EQ(labels(2, 2).front(), "0");
  EXPECT_EQ(labels(1000, 1000.001).front(), "0");
  EXPECT_EQ(labels(-1000.001, -1000).back(), "0");
  EXPECT_EQ(labels(1000, 1001).front(), "1000");
}

TEST(Plots, LeaveOutWhatHasNoLogarithm) {
  const Series some{"some", "#123456", {{10, 0}, {100, 1}, {1000, 10}}};
  const std::string svg = linePlot("t", {"x", true}, {"y", true}, {some});
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(linePlot("t", {"x", true}, {"y", true}, {{"none", "#123456", {{0, 0}}}}), "");
  Series holes = some;
  for (const double y : {std::nan(""), HUGE_VAL}) holes.points.push_back({1, y});
  EXPECT_EQ(linePlot("t", {"x", true}, {"y", true}, {holes}), svg);
}

TEST(Plots, HaveARowForEachName) {
  const std::vector<std::string> names{"jaw<Open", std::string(80, 'w'), "smile"};
  const std::string svg =
      rowPlot("t", "x", names, {{"max", "#123456", {{1, 0}, {2, 0}, {3, 0}}, true}}, 2.5);
  EXPECT_TRUE(isWellFormed(svg));
  EXPECT_NE(svg.find("jaw&lt;Open"), std::string::npos);
  EXPECT_EQ(countOf(svg, "<circle"), 4u);
}

TEST(Plots, ShortenNamesInTheMiddleByLetters) {
  std::string russian, chinese;
  for (int k = 0; k < 22; ++k) russian += "у";
  for (int k = 0; k < 40; ++k) chinese += "嘴";
  const std::string head(30, 'h'), tail(30, 't');
  const std::string svg = rowPlot("t", "x", {russian, chinese, head + tail},
                                  {{"max", "#123456", {{1, 0}, {2, 0}, {3, 0}}, true}}, 2.5);
  EXPECT_NE(svg.find(">" + russian + "<"), std::string::npos);
  EXPECT_NE(svg.find(">" + head.substr(0, 17) + "…" + tail.substr(0, 17) + "<"), std::string::npos)
      << svg;
  EXPECT_EQ(countOf(svg, "嘴"), 16u);
  EXPECT_TRUE(isWellFormed(svg));
  const std::string lines =
      linePlot("t", {"x"}, {"y"}, {{head + head + tail, "#123456", {{0, 0}, {1, 1}}}});
  EXPECT_NE(lines.find(">" + head.substr(0, 21) + "…" + tail.substr(0, 21) + "<"),
            std::string::npos);
}

TEST(Plots, NumberAxesWithinThePictureAndApart) {
  const std::string long_name(60, 'n');
  const std::string svg =
      rowPlot("t", "x", {long_name}, {{"max", "#123456", {{0.00033, 0}}, true}}, 0.0003);
  EXPECT_NE(svg.find(">0.0003<"), std::string::npos) << svg;
  EXPECT_EQ(svg.find(">0.00035<"), std::string::npos) << "there is no room for all";
  const std::string lines = rowPlot("t", "x", {"n"}, {{"max", "#123456", {{0.00033, 0}}, true}}, 0);
  EXPECT_NE(lines.find("x=\"600.0\""), std::string::npos) << lines;
}

// ---- What shape parameters do ----

TEST(ShapeStudies, PullTheSweepTowardsItsChord) {
  const Rig rig = converted(withTargets(plane(12, 10)), 0.05);
  const auto vectors = blend(rig, Weights(2, 0.0));
  const ShapeStudy study = studyShapes(rig.surface, vectors);
  ASSERT_EQ(study.shapes.size(), 4u);
  EXPECT_EQ(study.shapes[0].moved, 0);
  const auto height = [&](std::size_t k) {
    double sum = 0;
    for (const Vec2& p : study.shapes[k].profile) sum += std::abs(p.y);
    return sum;
  };
  EXPECT_LT(height(3), 0.5 * height(0)) << "a strong lambda is a straight line";
  EXPECT_LT(height(3), height(2));
  for (const ShapedPatch& s : study.shapes) {
    EXPECT_NEAR(s.profile.front().y, 0, 1e-9) << "the boundary curves stay";
    EXPECT_NEAR(s.profile.back().y, 0, 1e-9);
    // So do the corners.
    const auto& first = study.shapes[0].scene.positions;
    EXPECT_LE(norm(s.scene.positions.front() - first.front()), 1e-9);
    EXPECT_LE(norm(s.scene.positions.back() - first.back()), 1e-9);
  }
  // Without shape parameters it is the surface itself, if that has none either.
  const Surface& surface = rig.surface;
  const std::vector<Shape> none(surface.wireframe().ribbons.size());
  if (surface.wireframe().ribbons == none) {
    const Site middle{study.patch, 0.5 * surface.edgesU(study.patch),
                      0.5 * surface.edgesV(study.patch)};
    const Vec3 expected = surface.evaluate(vectors, middle);
    EXPECT_LE(norm(study.shapes[0].scene.positions[20 * 41 + 20] - expected), 1e-9);
  }
}

// ---- The whole report ----

/// A hill whose target names need escaping.
MeshRig hill() {
  MeshRig source = withTargets(plane(12, 10));
  source.targets[0].name = "<script>alert(1)</script>";
  source.targets[1].name = "mouth & \"eye\"";
  return source;
}

/// Expects the report's table rows to match the measurement.
void expectErrors(const std::string& report, const Measurement& measured) {
  const auto rowOf = [](const PoseErrors& e) {
    return fmt::format("{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}°</td>", e.name,
                       number(e.distance.max), number(e.distance.p999), number(e.distance.rms),
                       e.angle.rms);
  };
  EXPECT_EQ(countOf(report, "<tr class=\"strong\"><td>" + rowOf(measured.worst)), 1u);
  EXPECT_EQ(countOf(report, "<tr><td>" + rowOf(measured.shapes[0])), 1u);
  const auto& all = measured.worst.displacement;
  EXPECT_EQ(countOf(report, fmt::format("<td>displacements</td><td>{}</td><td>{}</td><td>{}</td>",
                                        number(all.rms), number(all.p999), number(all.max))),
            1u);
}

double shareOfC2(const Rig& rig) {
  double smooth = 0, all = 0;
  for (const JoinReport& join : examineJoins(rig.surface, blend(rig, {}))) {
    all += join.length;
    if (join.joinClass == JoinClass::c2) smooth += join.length;
  }
  return smooth / all;
}

/// Expects the numbers of a hill of 143 vertices and 120 polygons, whose file has 4,321 bytes.
void expectNumbers(const std::string& report, const Rig& rig, const PoseErrors& errors) {
  const Index stored = rig.surface.storedCount(), patches = rig.surface.patchCount();
  const ErrorSummary& distance = errors.distance;
  const std::string largest = number(distance.max), rms = number(distance.rms);
  for (const std::string& part :
       {fmt::format("<b>{}</b><span>of the vertices, as points", percent(stored / 143.0)),
        fmt::format("<b>{}</b><span>largest distance of a vertex, of 0.05 allowed", largest),
        fmt::format("<b>{}</b><span>of the curves", percent(shareOfC2(rig))),
        fmt::format("<b>{}</b><span>of the meshes", percent(4321 / 5148.0)),
        fmt::format("points, neutral</td><td>143</td><td>{}</td><td>{}</td>", stored,
                    percent(1 - stored / 143.0)),
        fmt::format("patches, neutral</td><td>120</td><td>{}</td><td>{}</td>", patches,
                    percent(1 - patches / 120.0)),
        fmt::format("all expressions</td><td>5,148</td><td>4,321</td><td>{}</td>",
                    percent(1 - 4321 / 5148.0)),
        fmt::format("<td>0.05, not packed</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
                    "<td>4,321</td>",
                    stored, percent(stored / 143.0), patches, rms),
        fmt::format("<td>.sweep, not packed, 0.05</td><td>4,321</td><td>{}</td><td>{}</td>"
                    "<td>{}</td>",
                    rms, number(distance.p999), largest)})
    EXPECT_EQ(countOf(report, part), 1u) << part;
}

/// The y of the first point of a line in a plot.
double startOf(const std::string& plot, const std::string& colour) {
  std::smatch found;
  const std::regex line(R"re(<polyline points="[0-9.]+,([0-9.]+) [^>]*stroke=")re" + colour);
  return std::regex_search(plot, found, line) ? std::stod(found[1]) : NAN;
}

TEST(Report, TellsAllAboutAFace) {
  const MeshRig source = hill();
  const Rig rig = converted(source, 0.05);
  ReportOptions options;
  options.name = "a&b.sweep";
  options.bytes = 4321;
  options.tolerances = {0.1};
  options.gltfpack = "./no<such";
  double last = 0;
  options.progress = [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
  };
  const auto report = makeReport(rig, source, options);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(isWellFormed(*report));
  EXPECT_EQ(report->find("<script"), std::string::npos);
  EXPECT_NE(report->find("&lt;script&gt;alert(1)&lt;/script&gt;"), std::string::npos);
  for (const std::string_view title :
       {"Original and recreated", "Size", "Wireframe", "Errors", "Displacements", "Continuity",
        "Error against points", "Error against bytes", "Shape parameters", "Linear and Newton",
        "Every law"})
    EXPECT_NE(report->find(fmt::format("<h2>{}</h2>", title)), std::string::npos) << title;
  // Nothing is loaded from elsewhere: the only URL is the SVG namespace.
  EXPECT_EQ(countOf(*report, "http"), countOf(*report, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(countOf(*report, "src="), countOf(*report, "src=\"data:image/png;base64,"));
  // 4 to compare, 2 of the wireframe, 4 heat maps, 2 of continuity, 4 shapes, 12 key frames.
  EXPECT_EQ(countOf(*report, "<img "), 28u);
  EXPECT_EQ(countOf(*report, "<img "), countOf(*report, " alt=\""));
  EXPECT_EQ(countOf(*report, "<svg "), 9u);
  const std::string words = withoutPictures(*report);
  EXPECT_EQ(countOf(words, "nan") + countOf(words, "inf,"), 0u);
  // The GLB's vertical line has a length even next to a single packed file.
  static const std::regex upright(
      R"re(<polyline points="[0-9.]+,([0-9.]+) [0-9.]+,([0-9.]+) "[^>]*stroke-dasharray)re");
  std::size_t lines = 0;
  for (std::sregex_iterator line(words.begin(), words.end(), upright), end; line != end; ++line) {
    EXPECT_NE((*line)[1], (*line)[2]) << line->str();
    ++lines;
  }
  EXPECT_GE(lines, 2u);
  for (const std::string_view row : {".sweep, 0.1<", "GLB, single"})
    EXPECT_NE(report->find(fmt::format("<td>{}", row)), std::string::npos) << row;
  EXPECT_NE(report->find("There is no program './no&lt;such"), std::string::npos);
  const std::string plot = words.substr(words.find("Distance over points"));
  EXPECT_LT(startOf(plot, sweepface::kRed), startOf(plot, sweepface::kBlue))
      << "more is allowed than there is";
  const Measurement measured = measure(rig, source, {.mixtures = 0}).value();
  expectErrors(*report, measured);
  expectNumbers(*report, rig, measured.worst);
}

TEST(MotionReport, NeedsAnExpression) {
  ConvertOptions options;
  options.tolerance = 0.01;
  const auto page = makeMotionReport(convert(withTargets(plane(2, 2), 0), options).value().rig, {});
  ASSERT_FALSE(page);
  EXPECT_NE(page.error().message.find("has no expressions that could move"), std::string::npos);
}

TEST(MotionReport, ShowsThePapersExperimentAndEveryLaw) {
  const MeshRig mesh = withTargets(plane(4, 4), 2);
  ConvertOptions convertOptions;
  convertOptions.tolerance = 0.01;
  const Rig rig = convert(mesh, convertOptions).value().rig;
  ReportOptions options;
  options.name = "face.sweep";
  options.expression = {1, 0.5};
  int pictures = 0;
  options.progress = [&](std::string_view, double done) {
    EXPECT_TRUE(done >= 0 && done <= 1);
    ++pictures;
  };
  const auto page = makeMotionReport(rig, options);
  ASSERT_TRUE(page) << page.error().message;
  EXPECT_EQ(countOf(*page, "<figure>"), 12u);  // two laws, six frames each
  EXPECT_NE(page->find("newton, frame 12: 16 %"), std::string::npos);
  EXPECT_NE(page->find("linear, frame 12: 40 %"), std::string::npos);
  EXPECT_EQ(countOf(*page, "@keyframes law"), 10u);
  EXPECT_EQ(countOf(*page, "class=\"law\""), 10u);
  EXPECT_EQ(countOf(*page, ">Velocity</text>"), 1u);
  EXPECT_GT(pictures, 30);
  options.expression = {0, 0};
  EXPECT_FALSE(makeMotionReport(rig, options));
  options.expression = {1};
  EXPECT_FALSE(makeMotionReport(rig, options));
  options.expression.clear();  // the target that moves furthest
  EXPECT_TRUE(makeMotionReport(rig, options));
}

TEST(Report, MayBeGivenUp) {
  const MeshRig source = hill();
  const Rig rig = converted(source, 0.05);
  std::atomic<bool> cancel = false;
  ReportOptions options;
  options.cancel = &cancel;
  options.progress = [&](std::string_view, double) { cancel = true; };
  EXPECT_TRUE(failsWith(makeReport(rig, source, options), {"was interrupted"}));
  cancel = false;
  EXPECT_TRUE(failsWith(makeMotionReport(rig, options), {"was interrupted"}));
}

TEST(Report, DoesWithoutTargetsAndTolerances) {
  const MeshRig source{plane(12, 10), {}};
  const auto report = makeReport(converted(source, 0.05), source, {});
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(isWellFormed(*report));
  EXPECT_EQ(report->find("Error against points"), std::string::npos);
  EXPECT_EQ(report->find("Error against bytes"), std::string::npos);
  EXPECT_EQ(report->find("Linear and Newton"), std::string::npos);
  EXPECT_EQ(report->find("<h2>Displacements"), std::string::npos);
  EXPECT_NE(report->find("Shape parameters"), std::string::npos);
}

TEST(Report, ShowsTheErrorsOfAnExpressionOnAScaleThatHoldsThem) {
  const MeshRig source = hill();
  MeshRig moved = source;
  moved.targets[0].positions.back().z += 0.75;
  ReportOptions options;
  options.expression = {1, 0};
  const auto report = makeReport(converted(source, 0.05), moved, options);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  const std::size_t title = report->find("<div class=\"scale\">distance");
  ASSERT_NE(title, std::string::npos);
  const std::size_t end = report->find("</span>", title), last = report->rfind("<b>", end);
  EXPECT_GE(std::stod(report->substr(last + 3)), 0.7);
}

TEST(Report, FailsWhereFaceAndMeshesDoNotBelongTogether) {
  const MeshRig source = hill();
  const Rig rig = converted(source, 0.05);
  EXPECT_TRUE(failsWith(makeReport(rig, {plane(3, 3), {}}, {}), {"16 vertices"}));
  ReportOptions options;
  options.expression = {1, 2, 3};
  EXPECT_TRUE(failsWith(makeReport(rig, source, options), {"3 weights", "2 targets"}));
  const MeshRig part{source.neutral, {source.targets[0]}};
  EXPECT_TRUE(failsWith(makeReport(rig, part, {}), {"no mesh of 'mouth & \"eye\"'"}));
  options = {};
  options.regions = {"nose"};
  options.progress = [](std::string_view, double) { ADD_FAILURE() << "before any work"; };
  EXPECT_TRUE(failsWith(makeReport(rig, source, options), {"No target", "'nose'"}));
  Rig coming = rig;
  for (Target& target : coming.targets) target.difference.clear();
  EXPECT_TRUE(failsWith(makeReport(coming, source, {}), {"not decoded yet"}));
  EXPECT_TRUE(failsWith(makeMotionReport(coming, {}), {"not decoded yet"}));
}

// Neither the meshes nor the formats compared with contain a scene.
TEST(Report, CountsAFaceWithoutItsScene) {
  const MeshRig source{plane(12, 10), {}};
  Rig rig = converted(source, 0.05);
  const std::size_t face = encode(rig).size();
  rig.scene.assign(50'000, 'x');
  ReportOptions options;
  options.bytes = encode(rig).size();
  const std::string page = makeReport(rig, source, options).value();
  EXPECT_NE(page.find("of the meshes' bytes: " + count(face) + " of"), std::string::npos);
  EXPECT_NE(page.find("scene, which takes " + count(options.bytes - face) + " more"),
            std::string::npos);
}

}  // namespace
}  // namespace sweepface
