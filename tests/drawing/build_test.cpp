#include <algorithm>
#include <cmath>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"

#include "codec/grid_size.hpp"
#include "drawing/drawings.hpp"
#include "fit/defaults.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

double radius(const Vec3& p) { return std::hypot(p.x, p.z); }

double largestRadiusError(const Rig& rig, double height, double wanted) {
  const Tessellation grid(rig.surface, 4);
  double worst = 0;
  const auto positions = grid.positions(neutralPose(rig));
  for (const Vec3& p : positions)
    if (std::abs(p.y - height) < 0.05) worst = std::max(worst, std::abs(radius(p) - wanted));
  return worst;
}

TEST(Vase, ofTheDocumentationIsBuilt) {
  const auto built = buildText(vaseText());
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_EQ(built->rig.surface.patchCount(), 2);
  EXPECT_EQ(built->rig.names.units, "cm");
  EXPECT_LT(built->largestMiss, 0.02);
  EXPECT_TRUE(built->missed.starts_with("the control of 'foot")) << built->missed;
}

TEST(Vase, isRound) {
  const Rig rig = made(vase());
  EXPECT_LT(largestRadiusError(rig, 0, 2), 0.04);
  EXPECT_LT(largestRadiusError(rig, 10, 2.5), 0.04);
  EXPECT_LT(largestRadiusError(rig, 2, 3.2), 0.1);   // the belly
  EXPECT_LT(largestRadiusError(rig, 8, 1.68), 0.1);  // the neck
}

TEST(Vase, isSmoothAlongItsSeams) {
  const Rig rig = made(vase());
  int smooth = 0;
  for (const JoinReport& join : examineJoins(rig.surface, neutralPose(rig))) {
    if (join.joinClass == JoinClass::boundary) continue;
    ++smooth;
    EXPECT_EQ(join.joinClass, JoinClass::c2);
    EXPECT_LT(join.secondJump, 1e-12);
  }
  EXPECT_EQ(smooth, 2);
}

TEST(Vase, hasItsExpression) {
  const Rig rig = made(vase());
  ASSERT_EQ(rig.targets.size(), 1u);
  EXPECT_EQ(rig.targets[0].name, "taller");
  for (double t : {0.0, 0.3, 1.0}) {
    EXPECT_NEAR(middleOf(rig, "rim right", t, {1}).y, 11, 1e-5);
    EXPECT_NEAR(middleOf(rig, "rim right", t, {0.5}).y, 10.5, 1e-5);
    EXPECT_NEAR(middleOf(rig, "foot left", t, {1}).y, 0, 1e-5);
  }
}

/// The square with control curves beside ab that rise into it. The third one reaches further than
/// the second.
Json withControls() {
  Json drawing = square();
  drawing["curves"][0]["points"] = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  Json control{{"beside", "ab"}, {"in", "square"}, {"spacing", {0.1, 0.3}}};
  for (int x = 0; x <= 4; ++x) {
    control["second"].push_back({x, 0.5, 0.1});
    control["third"].push_back({x, 1.4, 0.6});
  }
  drawing["controls"] = Json::array({control});
  return drawing;
}

TEST(Controls, giveTheSurfaceItsDerivativesAcross) {
  Json drawing = withControls();
  drawing["curves"][1]["edges"] = 5;  // the way from ab to dc
  const Rig rig = made(drawing);
  const auto expected =
      derivativesFromControls({}, {0, 0.5, 0.1}, {0, 1.4, 0.6}, {0.1, 0.3}).value();
  for (double u : {0.0, 2.0, 5.0, 8.0}) {
    const auto pose = neutralPose(rig);
    const Vec3 first = rig.surface.evaluate(pose, {0, u, 0}, 0, 1) * 5.0;
    const Vec3 second = rig.surface.evaluate(pose, {0, u, 0}, 0, 2) * 25.0;
    EXPECT_LT(norm(first - expected.first), 1e-4);
    EXPECT_LT(norm(second - expected.second), 1e-3);
  }
}

TEST(Controls, standOncePerCurveAndPatch) {
  Json drawing = vase();
  drawing["controls"].push_back(drawing["controls"][1]);
  EXPECT_NE(buildJson(drawing).error().message.find(
                "curve 'foot left' has control curves in patch 'left' already"),
            std::string::npos);
}

TEST(Controls, haveSharesOfTheWayAcrossForSpacing) {
  Json drawing = vase();
  for (const Json& spacing : {Json{10, 25}, Json{0, 0.5}, Json{0.5, 0.2}, Json{0.5}}) {
    drawing["controls"][0]["spacing"] = spacing;
    EXPECT_NE(refusal(drawing).find("two shares of the way across, above 0 and at most 1"),
              std::string::npos)
        << refusal(drawing);
  }
}

TEST(Controls, standWithinTheirPatch) {
  Json drawing = vase();
  for (Json& point : drawing["controls"][0]["third"]) point[1] = point[1].get<double>() + 30;
  EXPECT_NE(refusal(drawing).find("times as far away as their patch is wide"), std::string::npos)
      << refusal(drawing);
}

TEST(Controls, outOfOrderAreNamedAsWhatIsMissed) {
  Json drawing = vase();
  std::ranges::reverse(drawing["controls"][2]["second"]);
  const auto built = buildJson(drawing);
  ASSERT_TRUE(built);
  EXPECT_EQ(built->missed, "the control of 'rim right' in 'right'");
  EXPECT_GT(built->largestMiss, 0.1 * built->diagonal);
}

TEST(Controls, standWhereTheirMeanDistancesSay) {
  Json spaced = vase();
  for (Json& control : spaced["controls"]) {
    const bool foot = control["beside"].get<std::string>().starts_with("foot");
    // The seams are straight: |(0, 10, 0.5)|. The steps out of the foot are |(0, 1, 1)| and
    // |(0, 1, 0.6)|.
    const double length = std::hypot(10, 0.5);
    const double first = foot ? std::hypot(1, 1) : std::hypot(1, 0.7),
                 second = foot ? std::hypot(1, 0.6) : std::hypot(1, 0.2);
    control["spacing"] = {first / length, (first + second) / length};
  }
  const Rig a = made(vase()), b = made(spaced);
  for (Index v = 0; v < a.surface.storedCount(); ++v)
    EXPECT_LT(norm(a.neutral[v] - b.neutral[v]), 2e-3);
}

TEST(Controls, goWithTheirBoundary) {
  Json drawing = withControls();
  drawing["curves"][0]["edges"] = 4;
  drawing["expressions"] = Json::parse(R"([{"name": "tilt", "moves": {"b": [0, 0, 1]}},
      {"name": "wave", "moves": {"ab": {"points": [[0, 0, 0.1], [0, 0, 0.3], [0, 0, 0.2]]}}}])");
  const Rig rig = made(drawing);
  const auto slopeAt = [&](double u, const Weights& weights) {
    return rig.surface.evaluate(blend(rig, weights), {0, u, 0}, 0, 1);
  };
  for (const double u : {1.0, 2.0, 3.0, 4.0})
    for (const Weights& weights : {Weights{1, 0}, Weights{0, 1}})
      EXPECT_LT(norm(slopeAt(u, weights) - slopeAt(u, {0, 0})), 1e-4) << u;
}

TEST(Controls, needAPointBesideEachOfTheirBoundary) {
  for (const char* which : {"second", "third"}) {
    Json drawing = withControls();
    drawing["controls"][0][which].erase(4);
    EXPECT_NE(refusal(drawing).find("the control curves beside 'ab' need 5 points each"),
              std::string::npos)
        << refusal(drawing);
  }
}

TEST(Points, areWhereTheCurveGoes) {
  Json drawing = square();
  drawing["curves"][0]["points"] = {{1, 0, 0.5}, {2, 0, 0.7}, {3, 0, 0.5}};
  const auto built = buildJson(drawing);
  ASSERT_TRUE(built);
  EXPECT_LT(built->largestMiss, 1e-5);
  EXPECT_LT(norm(middleOf(built->rig, "ab", 0.5) - Vec3{2, 0, 0.7}), 1e-5);
}

TEST(Points, tooManyForACurveAreMissedAndTheMissIsTold) {
  Json drawing = square();
  for (int k = 1; k < 20; ++k)
    drawing["curves"][2]["points"].push_back({0.2 * k, 4, k % 2 ? 0.3 : -0.3});
  const auto built = buildJson(drawing);
  ASSERT_TRUE(built);
  EXPECT_GT(built->largestMiss, 0.2);
  EXPECT_LT(built->largestMiss, 0.5);
  EXPECT_EQ(built->missed, "curve 'dc'");
  EXPECT_EQ(built->rig.tolerance, built->largestMiss);
  drawing["tolerance"] = 0.1;
  EXPECT_NE(buildJson(drawing).error().message.find("curve 'dc' misses"), std::string::npos);
  for (const double none : {0.0, -0.1}) {
    drawing["tolerance"] = none;
    EXPECT_NE(buildJson(drawing).error().message.find("not above 0"), std::string::npos);
  }
}

TEST(Points, coincideInADrawingWithANodeFarAway) {
  Json drawing = vase();
  drawing["curves"][0]["points"] = Json::array({{1, 1, 1}, {1, 1, 1}});
  EXPECT_NE(refusal(drawing).find("coincides with the one before it."), std::string::npos)
      << refusal(drawing);
  drawing = vase();
  drawing["nodes"][0]["at"] = {0, 0, 1e30};
  EXPECT_NE(refusal(drawing).find("in a drawing that is 1e+30 wide"), std::string::npos)
      << refusal(drawing);
}

TEST(Patches, thatArePointsAreNone) {
  Json drawing = square();
  for (std::size_t k = 1; k < 4; ++k)
    drawing["nodes"][k] = {{"name", drawing["nodes"][k]["name"]},
                           {"with", drawing["nodes"][0]["name"]}};
  for (Json& curve : drawing["curves"]) curve["collapsed"] = true;
  EXPECT_NE(buildJson(drawing).error().message.find("so that it is a point"), std::string::npos)
      << buildJson(drawing).error().message;
}

TEST(References, nameSomethingWhereTheyAreGiven) {
  Json ribbon = square(), node = square();
  ribbon["curves"][0]["ribbon"] = "";
  node["nodes"][0]["with"] = "";
  for (const Json& drawing : {ribbon, node})
    EXPECT_NE(buildJson(drawing).error().message.find("has no name; leave it out"),
              std::string::npos);
}

TEST(Tolerance, thatIsNotGivenIsTheUsualOne) {
  EXPECT_DOUBLE_EQ(made(square()).tolerance, kDefaultTolerance * norm(Vec3{4, 4, 0}));
}

TEST(WhatNobodySays, bendsLeast) {
  const Rig rig = made(square());
  for (double u : {0.5, 3.0, 7.5})
    for (double v : {1.0, 4.5}) {
      EXPECT_LT(norm(rig.surface.evaluate(neutralPose(rig), {0, u, v}) - Vec3{u / 2, v / 2, 0}),
                1e-9);
    }
}

TEST(Edges, areThoseOfTheOppositeSide) {
  Json drawing = square();
  drawing["curves"][0]["edges"] = 8;
  drawing["curves"][3]["edges"] = 3;
  const Rig rig = made(drawing);
  EXPECT_EQ(rig.surface.edgesU(0), 8);
  EXPECT_EQ(rig.surface.edgesV(0), 3);
  EXPECT_EQ(rig.source.polygons.faceCount(), 24);
  EXPECT_EQ(rig.source.gridVertex.size(), 9u * 4u);
}

TEST(Edges, areAsManyAsACurveIsLong) {
  Json drawing = square();
  drawing["nodes"][2]["at"] = {4, 12, 0};
  drawing["nodes"][3]["at"] = {0, 12, 0};
  Rig rig = made(drawing);
  EXPECT_EQ(rig.surface.edgesU(0), 4);
  EXPECT_EQ(rig.surface.edgesV(0), 12);
  drawing["curves"][0]["edges"] = 8;  // two per unit
  rig = made(drawing);
  EXPECT_EQ(rig.surface.edgesV(0), 24);
}

TEST(Edges, areWholeNumbersThatAFileHolds) {
  Json drawing = square();
  for (const Json& none : {Json(0), Json(2.5), Json(codec::kLongestArc + 1)}) {
    drawing["curves"][0]["edges"] = none;
    EXPECT_NE(refusal(drawing).find("the edges must be a whole number from 1 to 65535"),
              std::string::npos)
        << refusal(drawing);
  }
}

TEST(TNodes, standOnTheSidesTheyDivide) {
  Json drawing = withTNode();
  drawing["curves"][0]["edges"] = 6;
  drawing["curves"][3]["edges"] = 2;  // de
  const Rig rig = made(drawing);
  EXPECT_EQ(rig.surface.connectivity().kinds[4], NodeKind::hanging);
  EXPECT_EQ(rig.surface.wireframe().arcs[4].edges, 4);
  EXPECT_LT(norm(middleOf(rig, "de", 1) - Vec3{4.0 / 3, 4, 0}), 1e-9);
  for (const JoinReport& join : examineJoins(rig.surface, neutralPose(rig)))
    EXPECT_LT(join.positionGap, 1e-12);
}

TEST(TNodes, arePassedNearWhereTheyAreDrawn) {
  Json drawing = withTNode();
  drawing["nodes"][4]["at"] = {2, 4.5, 0.3};
  const Rig rig = made(drawing);
  EXPECT_LT(norm(middleOf(rig, "de", 1) - Vec3{2, 4.5, 0.3}), 1e-5);
}

TEST(TNodes, chooseEdgesThatFitBothSides) {
  const Rig rig = made(withTNode());
  EXPECT_EQ(rig.surface.edgesU(0), rig.surface.edgesU(1) + rig.surface.edgesU(2));
  EXPECT_LT(norm(middleOf(rig, "de", 1) - Vec3{4.0 / 3, 4, 0}), 0.1);
}

TEST(TNodes, shareTheEdgesThatTheSideOppositeIsSaidToHave) {
  Json drawing = withTNode();
  drawing["curves"][0]["edges"] = 10;  // ab
  drawing["curves"][1]["edges"] = 40;  // bc: specified edges are this short
  const Rig rig = made(drawing);
  EXPECT_EQ(rig.surface.edgesU(1), 3);  // a third of ab, as drawn opposite
  EXPECT_EQ(rig.surface.edgesU(2), 7);
  drawing["curves"][0]["edges"] = 1;
  drawing["curves"][1].erase("edges");
  EXPECT_NE(refusal(drawing).find("side 3 of patch 'p0' has 1 edges, not counting a curve without "
                                  "'edges', and side 1 has 1"),
            std::string::npos)
      << refusal(drawing);
}

TEST(TNodes, withoutAPlaceAskForTheSpacingOfControlsThatTheyShouldTell) {
  Json drawing = withTNode();
  drawing["patches"][1]["name"] = "left";
  Json control{{"beside", "df"}, {"in", "left"}};
  control["second"] = {{0.3, 4, 0.1}, {0.3, 8, 0.1}};
  control["third"] = {{0.8, 4, 0.2}, {0.8, 8, 0.2}};
  drawing["controls"] = Json::array({control});
  EXPECT_NE(refusal(drawing).find("node 'e' needs 'at', since the control curves beside 'df' have "
                                  "no 'spacing' and curve 'de' tells it"),
            std::string::npos)
      << refusal(drawing);
  drawing["controls"][0]["spacing"] = {0.2, 0.6};
  EXPECT_EQ(refusal(drawing), "");
}

TEST(TNodes, goWithWhicheverCurvesMove) {
  Json drawing = withTNode();
  drawing["expressions"] =
      Json::parse(R"([{"name": "bend", "moves": {"de": [0, 0, 1], "ec": [0, 0, 2]}}])");
  EXPECT_TRUE(buildJson(drawing));
}

TEST(TNodes, withoutAPlaceAreNotMovedThemselves) {
  Json drawing = withTNode();
  drawing["expressions"] = Json::parse(R"([{"name": "up", "moves": {"e": [0, 0, 1]}}])");
  EXPECT_NE(refusal(drawing).find("node 'e' stands on the side of a patch and goes with it"),
            std::string::npos)
      << refusal(drawing);
}

TEST(TNodes, drawnAtAPlaceGoAlongWithTheirCurves) {
  Json drawing = withTNode();
  drawing["nodes"][4]["at"] = {2, 4.5, 0.3};
  Json moves;
  for (const Json& curve : drawing["curves"])
    moves[curve["name"].get<std::string>()] = Json::array({0, 0, 1});
  drawing["expressions"] = Json::array({{{"name", "up"}, {"moves", moves}}});
  const Rig rig = made(drawing);
  for (const double share : {0.25, 0.5, 1.0})
    EXPECT_LT(norm(middleOf(rig, "de", share, {1}) - middleOf(rig, "de", share) - Vec3{0, 0, 1}),
              1e-9);
  drawing["expressions"][0]["moves"]["ec"][2] = 2;
  EXPECT_NE(refusal(drawing).find("take node 'e' to different places"), std::string::npos);
}

TEST(TNodes, inACircleAreRefusedInWordsThatHelp) {
  Json drawing = Json::parse(R"({"format": "sweepface wireframe 1", "nodes": [], "curves": [],
      "patches": [{"sides": ["i0", "i1", "i2", "i3"]}]})");
  const std::vector<std::pair<int, int>> inner{{1, 1}, {2, 1}, {2, 2}, {1, 2}},
      outer{{0, 0}, {1, 0}, {3, 0}, {3, 1}, {3, 3}, {2, 3}, {0, 3}, {0, 2}};
  const auto add = [&](const std::string& name, const std::string& from, const std::string& to) {
    drawing["curves"].push_back({{"name", name}, {"from", from}, {"to", to}});
  };
  for (std::size_t k = 0; k < 8; ++k)
    drawing["nodes"].push_back(
        {{"name", "o" + std::to_string(k)}, {"at", {outer[k].first, outer[k].second, 0}}});
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string own = std::to_string(k), next = std::to_string((k + 1) % 4);
    drawing["nodes"].push_back({{"name", "n" + own}, {"at", {inner[k].first, inner[k].second, 0}}});
    add("i" + own, "n" + own, "n" + next);
    // A rectangle runs from the outside past one corner of the square to the next.
    add("s" + own, "o" + std::to_string(2 * k + 1), "n" + own);
    add("a" + own, "o" + std::to_string(2 * k), "o" + std::to_string(2 * k + 1));
    add("b" + own, "o" + std::to_string(2 * k + 1), "o" + std::to_string((2 * k + 2) % 8));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string own = std::to_string(k), next = std::to_string((k + 1) % 4);
    drawing["patches"].push_back(
        {{"sides", {"b" + own, "a" + next, Json::array({"s" + next, "-i" + own}), "-s" + own}}});
  }
  const std::string why = refusal(drawing);
  EXPECT_NE(why.find("stand on each other's in a circle"), std::string::npos) << why;
}

TEST(Names, ofOneThingAreNotWhatAnotherGoesBy) {
  Json drawing = withTNode();
  drawing["patches"][0]["name"] = "p1";  // what the second one goes by
  const auto built = buildJson(drawing);
  ASSERT_FALSE(built);
  EXPECT_NE(built.error().message.find("'p1' is what number 1, which has no name, goes by"),
            std::string::npos)
      << built.error().message;
  drawing["patches"][0]["name"] = "p0";  // its own
  EXPECT_TRUE(buildJson(drawing));
}

TEST(Names, areNeitherNumbersNorTooLong) {
  Json drawing = square();
  for (const auto& [name, why] : {std::pair{std::string("12"), "must not be a number"},
                                  {"-x", "must not be a number or begin with '-'"},
                                  {std::string(4097, 'x'), "is longer than 4096 bytes"}}) {
    drawing["patches"][0]["name"] = name;
    EXPECT_NE(refusal(drawing).find(why), std::string::npos) << refusal(drawing);
  }
}

TEST(References, areWrittenAsTheyWereReadWhateverTheyName) {
  Json drawing = square();
  const std::string name = "a\fb\t\"\\\x1f\xc3\xa9";
  drawing["curves"][0]["from"] = name;
  const auto read = parseDrawing(drawing.dump(), "drawn.json");
  ASSERT_TRUE(read) << read.error().message;
  const auto again = parseDrawing(formatDrawing(*read), "again.json");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->curves[0].from, name);
}

TEST(Rings, mayBeOnePatchAndOneCurve) {
  const Rig rig = made(tube());
  EXPECT_EQ(rig.surface.connectivity().kinds, std::vector<NodeKind>(2, NodeKind::crossing));
  EXPECT_LT(largestRadiusError(rig, 0, 2), 0.2);  // one quintic is a poor circle
  for (const JoinReport& join : examineJoins(rig.surface, neutralPose(rig)))
    EXPECT_LT(join.secondJump, 1e-12);
  EXPECT_EQ(rig.source.polygons.faceCount(), rig.surface.edgesU(0) * rig.surface.edgesV(0));
  EXPECT_GE(rig.surface.edgesV(0), 3);
}

TEST(Tips, areNodesAtOnePointWithCollapsedCurvesBetween) {
  const Rig rig = made(cone());
  EXPECT_EQ(std::ranges::count(rig.surface.connectivity().kinds, NodeKind::irregular), 3);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT(norm(middleOf(rig, "ray" + std::to_string(k), 0) - Vec3{0, 3, 0}), 1e-12);
  const Polygons& faces = rig.source.polygons;
  int triangles = 0;
  for (Index f = 0; f < faces.faceCount(); ++f) triangles += faces.faceSize(f) == 3;
  EXPECT_EQ(triangles,
            3 * rig.surface.wireframe().arcs[rig.find(Thing::curve, "arc0").value()].edges);
  for (const JoinReport& join : examineJoins(rig.surface, neutralPose(rig)))
    EXPECT_LT(join.positionGap, 1e-12);
}

TEST(Tips, haveNothingThatRunsBesideThem) {
  Json drawing = cone();
  const Json points = {{0, 3, 0}, {0, 3, 0}};
  drawing["controls"] =
      Json::array({{{"beside", "turn0"}, {"in", "slice0"}, {"second", points}, {"third", points}}});
  EXPECT_NE(refusal(drawing).find("curve 'turn0' is one point; nothing runs beside it"),
            std::string::npos)
      << refusal(drawing);
}

TEST(Tips, areWhereAllTheirNodesAreDrawn) {
  Json drawing = cone();
  const auto other = std::ranges::find_if(drawing["nodes"],
                                          [](const Json& node) { return node.contains("with"); });
  (*other)["at"] = {0, 3, 0};
  EXPECT_EQ(refusal(drawing), "");
  (*other)["at"] = {0, 4, 0};
  EXPECT_NE(refusal(drawing).find("is drawn at another place"), std::string::npos)
      << refusal(drawing);
}

/// A bow tie: whatever no curve leads to would have no tangents.
TEST(Tips, atOnePointHangTogether) {
  Json drawing = Json::parse(R"({"format": "sweepface wireframe 1",
    "nodes": [{"name": "p1", "at": [0, 0, 0]}, {"name": "p2", "with": "p1"},
              {"name": "p3", "at": [0, 0, 0]}, {"name": "p4", "with": "p3"},
              {"name": "a", "at": [4, -1, 0]}, {"name": "b", "at": [4, 1, 0]},
              {"name": "c", "at": [-4, 1, 0]}, {"name": "d", "at": [-4, -1, 0]}],
    "curves": [{"name": "t1", "from": "p2", "to": "p1", "collapsed": true},
               {"name": "t2", "from": "p4", "to": "p3", "collapsed": true},
               {"name": "p1a", "from": "p1", "to": "a"}, {"name": "ab", "from": "a", "to": "b"},
               {"name": "bp2", "from": "b", "to": "p2"}, {"name": "p3c", "from": "p3", "to": "c"},
               {"name": "cd", "from": "c", "to": "d"}, {"name": "dp4", "from": "d", "to": "p4"}],
    "patches": [{"sides": ["p1a", "ab", "bp2", "t1"]}, {"sides": ["p3c", "cd", "dp4", "t2"]}]})");
  EXPECT_EQ(refusal(drawing), "");
  for (const std::size_t n : {2u, 3u})
    drawing["nodes"][n] = {{"name", "p" + std::to_string(n + 1)}, {"with", "p1"}};
  EXPECT_NE(refusal(drawing).find("nodes 'p1' and 'p3' are tips at one point, but no collapsed"),
            std::string::npos)
      << refusal(drawing);
}

TEST(Tips, haveOneJet) {
  Json drawing = cone();
  const auto jet = [](double x) {
    return Json{{"along", "ray0"}, {"x", {x, -x, 0}}, {"y", {0, -x, x}},
                {"xx", {0, 0, 0}}, {"xy", {0, 0, 0}}, {"yy", {0, 0, 0}}};
  };
  for (Json& node : drawing["nodes"])
    if (node["name"] == "tip0" || node["name"] == "tip1") node["jet"] = jet(0.25);
  EXPECT_EQ(refusal(drawing), "");
  for (Json& node : drawing["nodes"])
    if (node["name"] == "tip1") node["jet"] = jet(0.75);
  EXPECT_NE(refusal(drawing).find("their jets say different things"), std::string::npos)
      << refusal(drawing);
}

TEST(Tips, drawnTwiceMoveAsOne) {
  Json drawing = cone();
  const auto other = std::ranges::find_if(drawing["nodes"],
                                          [](const Json& node) { return node.contains("with"); });
  (*other)["at"] = {0, 3, 0};
  const std::string name = (*other)["name"], host = (*other)["with"];
  const auto moving = [&](Json moves) {
    drawing["expressions"] = Json::array({Json::object({{"name", "up"}, {"moves", moves}})});
    return drawing;
  };
  const Json up = {0, 1, 0};
  const Rig one = made(moving({{name, up}})), both = made(moving({{name, up}, {host, up}})),
            hosts = made(moving({{host, up}}));
  EXPECT_EQ(one.targets[0].difference, both.targets[0].difference);
  EXPECT_EQ(hosts.targets[0].difference, both.targets[0].difference);
  EXPECT_NE(refusal(moving({{name, up}, {host, {0, 2, 0}}})).find("are one point"),
            std::string::npos);
}

TEST(Tips, moveAsOne) {
  Json drawing = cone();
  drawing["expressions"] = Json::parse(
      R"([{"name": "up", "moves": {"tip0": [0, 1, 0]}}, {"name": "too", "moves": {"tip2": [0, 1, 0]}}])");
  const Rig rig = made(drawing);
  EXPECT_EQ(rig.targets[0].difference, rig.targets[1].difference);
  EXPECT_LT(norm(middleOf(rig, "ray1", 0, {1, 0}) - Vec3{0, 4, 0}), 1e-12);
}

TEST(Creases, areSharpWhereTheyAreDeclared) {
  Json drawing = vase();
  drawing["creases"] = {"seam front", "seam back"};
  for (Json& control : drawing["controls"])  // each half bulges on its own
    for (const char* which : {"second", "third"})
      for (Json& p : control[which])
        p[0] = 1.5 * p[0].get<double>() + (control["in"] == "right" ? 0.5 : -0.5);
  const Rig rig = made(drawing);
  EXPECT_EQ(rig.surface.connectivity().kinds, std::vector<NodeKind>(4, NodeKind::creased));
  const auto joins = examineJoins(rig.surface, neutralPose(rig));
  for (const char* seam : {"seam front", "seam back"}) {
    const JoinReport& join = joins[rig.find(Thing::curve, seam).value()];
    EXPECT_EQ(join.joinClass, JoinClass::crease);
    EXPECT_LT(join.positionGap, 1e-12);
    EXPECT_GT(join.normalJump, 10);
  }
}

TEST(Creases, haveJetsThatAgree) {
  Json drawing = writtenCube();
  EXPECT_TRUE(buildJson(drawing));
  int refused = 0;
  for (const char* word : {"x", "y"})
    for (std::size_t jet = 0; jet < 3; ++jet) {
      Json edited = drawing;
      edited["nodes"][0]["jets"][jet][word] = {0, 0, 5};
      const auto built = buildJson(edited);
      if (built) continue;
      ++refused;
      EXPECT_NE(built.error().message.find("which says another"), std::string::npos)
          << built.error().message;
    }
  EXPECT_EQ(refused, 6) << "each is a derivative of two parts";
  drawing["nodes"][0]["jets"][1]["along"] = drawing["nodes"][0]["jets"][0]["along"];
  EXPECT_NE(refusal(drawing).find("two jets of node"), std::string::npos) << refusal(drawing);
}

/// Two corners of a triangle at one place: the curve between them has no length, and the jets at
/// both ends define it completely.
TEST(Nodes, withJetsMayHaveACurveOfNoLengthBetween) {
  MeshRig ring;
  ring.neutral.positions = {{0, 0, 0}, {1, 0, 0.3}, {0, 0, 0}, {1, 1, 0.3}};
  ring.neutral.polygons.corners = {0, 1, 3, 0, 3, 2};
  ring.neutral.polygons.faceStart = {0, 3, 6};
  ring.targets = {{"apart", ring.neutral.positions}};
  ring.targets[0].positions[0].x = 0.1;
  ring.targets[0].positions[3].z = 0.5;
  ConvertOptions options;
  options.tolerance = 0.01;
  options.pack = true;
  const auto conversion = convert(ring, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  const auto built = buildText(formatDrawing(draw(conversion->rig)));
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_EQ(built->rig.neutral, conversion->rig.neutral);
}

TEST(Nodes, whereTwoPatchesMeetInsideTheSurfaceMayBeDrawn) {
  const Rig rig = made(Json::parse(R"({"format": "sweepface wireframe 1",
      "nodes": [{"name": "a", "at": [0, 0, 0]}, {"name": "b", "at": [4, 0, 0]},
                {"name": "c", "at": [4, 4, 0]}, {"name": "d", "at": [0, 4, 0]},
                {"name": "x", "at": [2, 2, 0]}],
      "curves": [{"name": "ab", "from": "a", "to": "b"}, {"name": "bc", "from": "b", "to": "c"},
                 {"name": "cd", "from": "c", "to": "d"}, {"name": "da", "from": "d", "to": "a"},
                 {"name": "ax", "from": "a", "to": "x"}, {"name": "xc", "from": "x", "to": "c"}],
      "patches": [{"sides": ["ab", "bc", "-xc", "-ax"]}, {"sides": ["ax", "xc", "cd", "da"]}]})"));
  EXPECT_EQ(rig.surface.patchCount(), 2);
  for (const Vec3& v : rig.neutral) EXPECT_TRUE(isFinite(v));
  EXPECT_LT(norm(middleOf(rig, "xc", 0) - Vec3{2, 2, 0}), 1e-12);
}

TEST(Ribbons, thatNoCurveBelongsToAreLeftOut) {
  Json drawing = vase();
  const std::string bytes = encode(made(drawing));
  for (const char* name : {"tight", "loose", "wavy"})
    drawing["ribbons"].insert(drawing["ribbons"].begin(),
                              Json::object({{"name", name}, {"eta", -1}}));
  EXPECT_TRUE(encode(made(drawing)) == bytes);
}

TEST(Ribbons, pullAtWhatIsDrawn) {
  Json drawing = vase();
  const Rig plain = made(drawing);
  drawing["ribbons"][0]["eta"] = -1;
  const Rig tight = made(drawing);
  EXPECT_EQ(plain.neutral, tight.neutral);
  const Index seam = plain.find(Thing::curve, "seam front").value();
  EXPECT_EQ(tight.surface.wireframe().ribbons[tight.surface.wireframe().arcs[seam].ribbon],
            (Shape{1, -1, 0}));
  EXPECT_GT(norm(middleOf(plain, "seam front", 0.4) - middleOf(tight, "seam front", 0.4)), 0.05);
}

TEST(Ribbons, reachAllCurvesAlongASweepAndNoOthers) {
  const Rig rig = made(vase());
  const auto ribbon = [&](const char* curve) {
    return rig.surface.wireframe().arcs[rig.find(Thing::curve, curve).value()].ribbon;
  };
  EXPECT_EQ(ribbon("seam back"), 0);
  std::set<Index> others;
  for (const char* curve : {"foot right", "foot left", "rim right", "rim left"})
    others.insert(ribbon(curve));
  EXPECT_EQ(others.size(), 4u);
  EXPECT_FALSE(others.contains(0));
  EXPECT_EQ(rig.nameOf(Thing::ribbon, 0), "body");
}

TEST(Expressions, thatAreNotDecodedAreNotDrawn) {
  Rig rig = made(vase());
  ASSERT_EQ(draw(rig).expressions.size(), 1u);
  rig.targets[0].difference.clear();
  EXPECT_TRUE(draw(rig).expressions.empty());
}

TEST(Expressions, moveSinglePointsOnTop) {
  Json drawing = square();
  drawing["curves"][0]["points"] = {{1, 0, 0.5}, {2, 0, 0.7}, {3, 0, 0.5}};
  drawing["expressions"] = Json::parse(R"([
      {"name": "bulge", "moves": {"ab": {"points": [[0, 0, 0.3], [0, 0, 0.5], [0, 0, 0.3]]}}},
      {"name": "more", "moves": {"ab": {"by": [0, 0, 2], "points": [[0, 0, 0.3], [0, 0, 0.5], [0, 0, 0.3]]}}}])");
  const Rig rig = made(drawing);
  EXPECT_LT(norm(middleOf(rig, "ab", 0.5, {1, 0}) - Vec3{2, 0, 1.2}), 1e-4);
  EXPECT_LT(norm(middleOf(rig, "ab", 0.5, {0, 1}) - Vec3{2, 0, 3.2}), 1e-4);
  EXPECT_LT(norm(middleOf(rig, "ab", 0, {1, 0})), 1e-12);
  EXPECT_LT(norm(middleOf(rig, "ab", 0, {0, 1}) - Vec3{0, 0, 2}), 1e-12);
}

TEST(Expressions, moveAllPointsOfACurveOrNone) {
  Json drawing = square();
  drawing["curves"][0]["points"] = {{1, 0, 0.5}, {2, 0, 0.7}, {3, 0, 0.5}};
  drawing["expressions"] = Json::parse(
      R"([{"name": "bulge", "moves": {"ab": {"points": [[0, 0, 0.3], [0, 0, 0.5]]}}}])");
  EXPECT_NE(refusal(drawing).find("2 offsets are given for the 3 points of curve 'ab'"),
            std::string::npos)
      << refusal(drawing);
}

TEST(Expressions, thatMissTheirPointsAreTold) {
  Json drawing = vase();
  drawing["expressions"][0]["moves"] =
      Json::parse(R"({"rim right": {"points": [[0, 0, 0], [1, 0, 0], [0, 0, 0]]}})");
  const auto built = buildJson(drawing);
  ASSERT_TRUE(built);
  EXPECT_GT(built->largestMiss, 0.3);
  EXPECT_EQ(built->missedIn, "taller");
}

TEST(Expressions, areNotBlamedForWhatTheNeutralMisses) {
  Json drawing = vase();
  for (Json& curve : drawing["curves"])
    if (curve["name"] == "rim right")
      curve["points"][1][0] = curve["points"][1][0].get<double>() + 5;
  Json still = drawing;
  still.erase("expressions");
  drawing["expressions"][0]["moves"] =
      Json::parse(R"({"rim right": {"points": [[0, 0, 0], [1, 0, 0], [0, 0, 0]]}})");
  const auto built = buildJson(drawing);
  ASSERT_TRUE(built);
  EXPECT_GT(built->largestMiss, buildJson(still)->largestMiss + 0.1);
  EXPECT_EQ(built->missedIn, "");
}

TEST(Expressions, moveOnlyJetsThatThereAre) {
  Json drawing = vase();
  const std::string node = drawing["nodes"][0]["name"];
  drawing["expressions"][0]["moves"] = {{node, {{"by", {0, 0, 1}}, {"x", {1, 0, 0}}}}};
  EXPECT_NE(refusal(drawing).find("node '" + node + "' has no jet that could move"),
            std::string::npos)
      << refusal(drawing);
}

TEST(Misses, areSharesOfAllThatIsDrawn) {
  EXPECT_NEAR(buildJson(tube())->diagonal, norm(Vec3{4, 5, 4}), 1e-12);
}

TEST(Expressions, areLinear) {
  Json one = vase(), two = vase();
  two["expressions"][0]["moves"] = {{"rim right", {0, 2, 0}}, {"rim left", {0, 2, 0}}};
  const Rig a = made(one), b = made(two);
  for (Index v = 0; v < a.surface.storedCount(); ++v)
    EXPECT_LT(norm(2.0 * a.targets[0].difference[v] - b.targets[0].difference[v]), 1e-9);
}

TEST(Expressions, letANodeGoItsOwnWay) {
  Json drawing = vase();
  drawing["expressions"][0]["moves"]["rim front"] = {0, 3, 0};
  const Rig rig = made(drawing);
  EXPECT_NEAR(middleOf(rig, "rim right", 0, {1}).y, 13, 1e-9);
  EXPECT_NEAR(middleOf(rig, "rim right", 1, {1}).y, 11, 1e-9);
}

// The order of the file's lists determines numbers, not shapes.
TEST(Order, ofPatchesDoesNotTurnAnyJet) {
  Json drawing = Json::parse(formatDrawing(draw(made(vase()))));
  const Rig before = made(drawing);
  std::swap(drawing["patches"][0], drawing["patches"][1]);
  std::swap(drawing["nodes"][0], drawing["nodes"][2]);
  const Rig after = made(drawing);
  for (double u : {0.0, 3.0, 9.0})
    for (double v : {0.0, 2.5, 8.0}) {
      EXPECT_LT(norm(before.surface.evaluate(neutralPose(before), {0, u, v}) -
                     after.surface.evaluate(neutralPose(after), {1, u, v})),
                1e-12);
    }
}

TEST(Order, ofPatchesDoesNotTurnAnyChart) {
  for (Json drawing : {Json::parse(formatDrawing(draw(made(cone()))))}) {
    const Rig before = made(drawing);
    std::ranges::rotate(drawing["patches"], drawing["patches"].begin() + 1);
    std::ranges::rotate(drawing["curves"], drawing["curves"].begin() + 4);
    const Rig after = made(drawing);
    for (double u : {0.0, 3.0, 7.0})
      for (double v : {0.0, 2.5, 8.0})
        for (Index p = 0; p < 3; ++p) {
          EXPECT_LT(norm(before.surface.evaluate(neutralPose(before), {(p + 1) % 3, u, v}) -
                         after.surface.evaluate(neutralPose(after), {p, u, v})),
                    1e-12);
        }
  }
}

}  // namespace
}  // namespace sweepface
