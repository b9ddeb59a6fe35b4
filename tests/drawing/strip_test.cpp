// Drawings of patches in a row, which show the effects of distance and of narrow patches.
#include <cmath>

#include "drawing/drawings.hpp"

namespace sweepface::testing {
namespace {

/// A band of patches along x, one unit wide with four edges across; the places are (x, z).
Json strip(const std::vector<Vec2>& places) {
  Json drawing = {{"format", "sweepface wireframe 1"},
                  {"nodes", Json::array()},
                  {"curves", Json::array()},
                  {"patches", Json::array()}};
  const auto curve = [&](const std::string& from, const std::string& to) -> Json& {
    drawing["curves"].push_back({{"name", from + to}, {"from", from}, {"to", to}});
    return drawing["curves"].back();
  };
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::string name = std::to_string(k), a = "a" + name, b = "b" + name;
    drawing["nodes"].push_back({{"name", a}, {"at", {places[k].x, 0, places[k].y}}});
    drawing["nodes"].push_back({{"name", b}, {"at", {places[k].x, 1, places[k].y}}});
    curve(a, b)["edges"] = 4;
    if (k == 0) continue;
    const std::string before = std::to_string(k - 1), c = "a" + before, d = "b" + before;
    curve(c, a);
    curve(d, b);
    drawing["patches"].push_back({{"sides", {c + a, a + b, "-" + d + b, "-" + c + d}}});
  }
  return drawing;
}

// Points of an arc, the middle two close together: the narrow patch between them must not absorb
// the bend of the wide ones beside it.
TEST(WhatNobodySays, spreadsABendOverNarrowAndWidePatches) {
  const auto onArc = [](double degrees) {
    const double angle = degrees * 3.14159265358979 / 180;
    return Vec2{10 * std::sin(angle), 10 * std::cos(angle)};
  };
  const Rig rig = made(strip(
      {onArc(-60), onArc(-40), onArc(-20), onArc(-4), onArc(4), onArc(20), onArc(40), onArc(60)}));
  const double edges = rig.surface.edgesU(3);
  const auto pose = neutralPose(rig);
  const Vec3 first = rig.surface.evaluate(pose, {3, edges / 2, 2}, 1, 0);
  const Vec3 second = rig.surface.evaluate(pose, {3, edges / 2, 2}, 2, 0);
  const double curvature = norm(cross(first, second)) / std::pow(norm(first), 3);
  EXPECT_LT(curvature, 0.2);  // 0.1 on the arc
}

TEST(Expressions, leaveNoTracesFarAway) {
  std::vector<Vec2> places;
  for (int k = 0; k <= 30; ++k) places.push_back({static_cast<double>(k), 0});
  Json drawing = strip(places);
  drawing["expressions"] =
      Json::parse(R"([{"name": "lift", "moves": {"a0": [0, 0, 1], "b0": [0, 0, 1]}}])");
  const Rig rig = made(drawing);
  const auto rest = neutralPose(rig), lifted = blend(rig, Weights{1});
  EXPECT_GT(norm(rig.surface.evaluate(lifted, {1, 2, 2}) - rig.surface.evaluate(rest, {1, 2, 2})),
            0.01);
  EXPECT_EQ(rig.surface.evaluate(lifted, {25, 2, 2}), rig.surface.evaluate(rest, {25, 2, 2}));
}

TEST(Materials, areThoseOfTheFacesOnAPatch) {
  Json drawing = strip({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  drawing["patches"][0]["material"] = "clay";
  drawing["patches"][2]["material"] = "glass";
  const Rig rig = made(drawing);
  const Polygons& faces = rig.source.polygons;
  EXPECT_EQ(faces.materials, (std::vector<std::string>{"clay", "glass"}));
  ASSERT_EQ(faces.faceMaterial.size(), static_cast<std::size_t>(faces.faceCount()));
  EXPECT_EQ(faces.faceMaterial.front(), 0);
  EXPECT_EQ(faces.faceMaterial[faces.faceCount() / 2], -1);
  EXPECT_EQ(faces.faceMaterial.back(), 1);
  const auto again = parseDrawing(formatDrawing(draw(rig)), "again");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->patches[0].material, "clay");
  EXPECT_EQ(again->patches[1].material, "");
  EXPECT_EQ(again->patches[2].material, "glass");
}

TEST(Materials, areGivenToTheFacesOfASourceOnlyWhereItSaysWhichLieOnAPatch) {
  Json drawing = strip({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  Rig like = made(drawing);
  drawing["patches"][1]["material"] = "glass";
  Rig rig = made(drawing);
  ASSERT_TRUE(adoptSource(rig, like));
  EXPECT_EQ(rig.source.polygons.materials, std::vector<std::string>{"glass"});
  const Index third = rig.source.polygons.faceCount() / 3;
  EXPECT_EQ(std::ranges::count(rig.source.polygons.faceMaterial, 0), third);
  EXPECT_EQ(rig.source.polygons.faceMaterial[third], 0);

  like.source.quadCorners.clear();
  const SourceMesh before = rig.source;
  const auto refused = adoptSource(rig, like);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with("The drawing names materials"));
  EXPECT_EQ(rig.source.quadCorners, before.quadCorners);
}

TEST(Sources, areKeptOfTheSameCurvesAndPatchesOnly) {
  const Json drawing = strip({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  const Rig like = made(drawing);
  const auto refusal = [&](const Json& other) {
    Rig rig = made(other);
    const auto kept = adoptSource(rig, like);
    return kept ? "" : kept.error().message;
  };
  EXPECT_EQ(refusal(drawing), "");
  Json turned = drawing;
  std::rotate(turned["patches"].begin(), turned["patches"].begin() + 1, turned["patches"].end());
  EXPECT_TRUE(refusal(turned).starts_with("Patch 'p0' is not as in the file whose source"))
      << refusal(turned);
  Json swapped = drawing;
  std::swap(swapped["curves"][0], swapped["curves"][1]);
  EXPECT_TRUE(refusal(swapped).starts_with("Curve 'a1b1' is not as in")) << refusal(swapped);
  const std::string shorter = refusal(strip({{0, 0}, {1, 0}, {2, 0}}));
  EXPECT_TRUE(shorter.starts_with("The number of nodes, curves or patches is not as in"))
      << shorter;
}

TEST(Materials, areNoneWhereNobodyNamesOne) {
  EXPECT_TRUE(made(square()).source.polygons.faceMaterial.empty());
}

}  // namespace
}  // namespace sweepface::testing
