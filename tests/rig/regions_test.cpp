#include "sweepface/regions.hpp"

#include <random>
#include <set>

#include "sweepface/eval.hpp"
#include "sweepface/evaluator.hpp"
#include "sweepface/fit.hpp"

#include "codec/rigs.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// A converted face with two expressions.
Rig converted(const PolygonMesh& mesh) {
  ConvertOptions options;
  options.tolerance = 0.01;
  auto made = convert(withTargets(mesh), options);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return made->rig;
}
const Rig& hill() {
  static const Rig rig = converted(plane());
  return rig;
}
const Rig& ball() {
  static const Rig rig = converted(cubeSphere());
  return rig;
}

std::vector<Vec3> nodePlaces(const Rig& rig) {
  const auto vectors = blend(rig, {});
  std::vector<Vec3> places(rig.surface.wireframe().nodes.size());
  for (Index a = 0; a < static_cast<Index>(rig.surface.wireframe().arcs.size()); ++a) {
    const Arc& arc = rig.surface.wireframe().arcs[a];
    places[arc.from] = rig.surface.pointOnArc(vectors, a, 0);
    places[arc.to] = rig.surface.pointOnArc(vectors, a, arc.edges);
  }
  return places;
}

Brush around(const Vec3& point, double whole, double fade, bool alongSurface) {
  Brush brush;
  brush.points = {point};
  brush.whole = whole, brush.fade = fade, brush.alongSurface = alongSurface;
  return brush;
}

std::vector<double> painted(const Rig& rig, const Brush& brush) {
  const auto shares = paint(rig, brush);
  EXPECT_TRUE(shares) << (shares ? "" : shares.error().message);
  return shares.value_or(std::vector<double>(rig.surface.wireframe().nodes.size()));
}

/// Three overlapping regions and the rest.
std::vector<Region> someRegions(const Rig& rig) {
  const auto places = nodePlaces(rig);
  const auto regions =
      dividedFace(rig, {{"a", {}, painted(rig, around(places.front(), 1, 6, false))},
                        {"b", {}, painted(rig, around(places.back(), 1, 6, false))},
                        {"c", {}, painted(rig, around(places[places.size() / 2], 2, 3, false))}});
  EXPECT_TRUE(regions);
  return *regions;
}

std::vector<double> anyWeights(std::size_t count) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-0.3, 1);
  std::vector<double> weights(count);
  for (double& w : weights) w = uniform(random);
  return weights;
}

std::vector<Vec3> blended(const Rig& rig, std::span<const Region> regions,
                          std::span<const double> weights) {
  std::vector<Vec3> vectors(rig.surface.vectorCount());
  blend(rig, regions, weights, vectors);
  return vectors;
}

/// Two patches that touch at one corner: nodes 2 and 4 share a point.
Rig touching() {
  Wireframe w = onePatch(2, 2);
  const Wireframe other = w;
  w.points = 7;
  for (Index point : {2, 4, 5, 6}) w.nodes.push_back({point, kWholeJet});
  for (const Arc& a : other.arcs) w.arcs.push_back(arc(a.from + 4, a.to + 4, a.edges, a.ribbon));
  w.patches.push_back({{4, 5, 6, 7, 8}});
  for (const HalfArc h : other.loops) w.loops.push_back(h + 8);
  return makeRig(w);
}

// ---- Painting ----

TEST(Regions, FadeWithTheDistanceFromAPoint) {
  const auto places = nodePlaces(hill());
  const auto shares = painted(hill(), around(places[0], 2, 4, false));
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double t = (norm(places[n] - places[0]) - 2) / 4;
    const double expected = t <= 0 ? 1
                            : t >= 1
                                ? 0
                                : 1 - 10 * t * t * t + 15 * std::pow(t, 4) - 6 * std::pow(t, 5);
    EXPECT_NEAR(shares[n], expected, 1e-12) << n;
  }
}

TEST(Regions, FadeWithTheDistanceFromALine) {
  Brush brush = around({}, 1, 2, false);
  brush.points.clear();
  brush.line = {{-100, 0, 0}, {100, 0, 0}};
  const auto places = nodePlaces(ball());
  const auto shares = painted(ball(), brush);
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double distance = std::hypot(places[n].y, places[n].z);
    if (distance < 1) {
      EXPECT_EQ(shares[n], 1);
    }
    if (distance > 3) {
      EXPECT_EQ(shares[n], 0);
    }
    if (distance > 1.01 && distance < 2.99) {
      EXPECT_TRUE(shares[n] > 0 && shares[n] < 1);
    }
  }
}

TEST(Regions, ALineOfOnePointIsThatPoint) {
  const Brush point = around(nodePlaces(hill())[0], 2, 4, false);
  Brush line = point;
  std::swap(line.points, line.line);
  EXPECT_EQ(painted(hill(), line), painted(hill(), point));
}

TEST(Regions, ThroughSpaceACurveIsALineOfFourPiecesPerEdge) {
  const auto vectors = blend(ball(), {});
  const auto& arcs = ball().surface.wireframe().arcs;
  for (Index a = 0; a < std::ssize(arcs); ++a) {
    Brush curve;
    curve.curves = {"c" + std::to_string(a)};
    curve.whole = 1e-9, curve.fade = 6, curve.alongSurface = false;
    Brush line = curve;
    line.curves.clear();
    for (Index k = 0; k <= 4 * arcs[a].edges; ++k)
      line.line.push_back(ball().surface.pointOnArc(vectors, a, k / 4.0));
    const auto shares = painted(ball(), curve);
    EXPECT_EQ(shares[arcs[a].from], 1) << a;
    EXPECT_EQ(shares[arcs[a].to], 1) << a;
    EXPECT_EQ(shares, painted(ball(), line)) << a;
  }
}

// Two nearly coincident sheets, a twentieth of an edge apart.
TEST(Regions, CurvesReachAlongTheSurfaceAlone) {
  const Rig rig = converted(joined(plane(6, 5), plane(6, 5), {0.02, 0.02, 0.05}));
  const auto& arcs = rig.surface.wireframe().arcs;
  const auto places = nodePlaces(rig);
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    Brush brush;
    brush.curves = {"c" + std::to_string(a)};
    brush.whole = 0.2;
    const auto shares = painted(rig, brush);
    for (std::size_t n = 0; n < shares.size(); ++n) {
      const bool isItsEnd = places[n] == places[arcs[a].from] || places[n] == places[arcs[a].to];
      EXPECT_EQ(shares[n], isItsEnd ? 1 : 0) << "curve " << a << ", node " << n;
    }
  }
}

TEST(Regions, LinesMissNoNodeOnThem) {
  PolygonMesh squares;
  for (int k = 0; k < 40; ++k)
    squares = joined(std::move(squares),
                     grid(1, 1, [](double x, double y) { return Vec3{x, y, 0}; }), {2.0 * k, 0, 0});
  const Rig rig = converted(squares);
  Brush brush;
  brush.line = {{0, 0, 0}, {80, 0, 0}};
  brush.whole = 0.2;
  const auto places = nodePlaces(rig);
  const auto shares = painted(rig, brush);
  for (std::size_t n = 0; n < shares.size(); ++n)
    EXPECT_EQ(shares[n], std::abs(places[n].y) < 0.2 ? 1 : 0) << places[n].x << " " << places[n].y;
}

// The far side of the ball is 8 away through its centre, but at least 12.6 along the surface.
TEST(Regions, WaysAlongTheSurfaceAreLonger) {
  const auto places = nodePlaces(ball());
  const Vec3 pole{0, 0, 4};
  const auto straight = painted(ball(), around(pole, 9, 0, false));
  const auto along = painted(ball(), around(pole, 9, 0, true));
  int differ = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    EXPECT_EQ(straight[n], 1);
    if (places[n].z < -3.5) {
      EXPECT_EQ(along[n], 0);
    }
    if (places[n].z > 0) {
      EXPECT_EQ(along[n], 1);
    }
    differ += along[n] != straight[n];
  }
  EXPECT_GT(differ, 0);
}

TEST(Regions, MaterialsAndGroupsArePainted) {
  PolygonMesh mesh = cubeSphere(8);
  Polygons& faces = mesh.polygons;
  faces.materials = {"left", "right"};
  faces.groups = {"back", "front"};
  for (Index f = 0; f < faces.faceCount(); ++f) {
    Vec3 sum;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c)
      sum += mesh.positions[faces.corners[c]];
    faces.faceMaterial.push_back(sum.x < 0 ? 0 : 1);
    faces.faceGroup.push_back(sum.z < 0 ? 0 : 1);
  }
  const Rig rig = converted(mesh);
  const auto places = nodePlaces(rig);
  Brush brush;
  for (const auto& [part, inwards] : {std::pair{"left", Vec3{-1, 0, 0}},
                                      {"right", Vec3{1, 0, 0}},
                                      {"back", Vec3{0, 0, -1}},
                                      {"front", Vec3{0, 0, 1}}}) {
    brush.parts = {part};
    brush.fade = 0;
    const auto shares = painted(rig, brush);
    brush.fade = 6;
    const auto soft = painted(rig, brush);
    int inside = 0, between = 0;
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double depth = dot(places[n], inwards);
      if (depth > 1) {
        EXPECT_EQ(shares[n], 1) << part;
        ++inside;
      }
      if (depth < -1) {
        EXPECT_EQ(shares[n], 0) << part;
      }
      EXPECT_GE(soft[n], shares[n]);
      between += soft[n] > 0 && soft[n] < 1;
    }
    EXPECT_GT(inside, 0);
    EXPECT_GT(between, 0);
  }
  brush.alongSurface = false;
  EXPECT_FALSE(paint(rig, brush)) << "parts reach over the surface";
  brush.alongSurface = true;
  brush.parts = {"middle"};
  const auto none = paint(rig, brush);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("'middle'; it has left, right, back, front"),
            std::string::npos);
}

// Patches of 3 × 2 and 2 × 2 quads; one of the four quads at the ends of the seam is in the part.
TEST(Regions, NodesOnASeamBelongToAPartAsFarAsTheQuadsAroundThemDo) {
  Rig rig = makeRig(twoPatches());
  rig.source.polygons.materials = {"skin", "lips"};
  rig.source.polygons.faceMaterial = {0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
  Brush brush;
  brush.parts = {"lips"};
  EXPECT_EQ(painted(rig, brush), (std::vector<double>{0, 0.5, 0, 0, 0, 0}));
  brush.whole = 1e-9;
  EXPECT_EQ(painted(rig, brush), (std::vector<double>{0, 1, 0, 0, 0, 0}))
      << "wholly where the brush goes farther";
}

TEST(Regions, NodesHaveTheSharesTheyAreGiven) {
  Brush brush = around(nodePlaces(hill())[0], 100, 0, false);
  brush.nodes = {{"n1", 0.25}, {"2", 0}};
  const auto shares = painted(hill(), brush);
  EXPECT_EQ(shares[0], 1);
  EXPECT_EQ(shares[1], 0.25);
  EXPECT_EQ(shares[2], 0);
  brush.nodes = {{"n1", 1.5}};
  EXPECT_FALSE(paint(hill(), brush));
  brush.nodes = {{"nobody", 1}};
  EXPECT_FALSE(paint(hill(), brush));
  brush.nodes = {{"n1", 0.25}, {"1", 1}};
  const auto twice = paint(hill(), brush);
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().message.find("told twice"), std::string::npos);
}

TEST(Regions, NodesAtOnePointHaveOneShare) {
  const Rig rig = touching();
  Brush brush;
  brush.nodes = {{"n4", 0.25}};
  EXPECT_EQ(painted(rig, brush), (std::vector<double>{0, 0, 0.25, 0, 0.25, 0, 0, 0}));
}

TEST(Regions, WaysAlongTheSurfaceGoOnThroughAPoint) {
  const Rig rig = touching();
  const Brush brush = around(nodePlaces(rig)[0], 1e3, 0, true);
  EXPECT_EQ(painted(rig, brush), std::vector<double>(8, 1.0));
}

TEST(Regions, NodesOnTheSideOfAPatchHaveNoShareOfTheirOwn) {
  const Rig rig = makeRig(tee());
  const auto& kinds = rig.surface.connectivity().kinds;
  const auto hanging = std::ranges::find(kinds, NodeKind::hanging) - kinds.begin();
  Brush brush;
  brush.nodes = {{"n" + std::to_string(hanging), 1}};
  const auto shares = paint(rig, brush);
  ASSERT_FALSE(shares);
  EXPECT_NE(shares.error().message.find("stands on the side of a patch"), std::string::npos);
}

TEST(Regions, BandsFollowEachOther) {
  const auto places = nodePlaces(hill());
  const auto bands = paintBands(hill(), around(places[0], 0, 12, false), 5);
  ASSERT_TRUE(bands);
  for (std::size_t n = 0; n < places.size(); ++n) {
    double sum = 0, middle = 0;
    for (std::size_t b = 0; b < 5; ++b) {
      sum += (*bands)[b][n];
      middle += static_cast<double>(b) * (*bands)[b][n];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(middle, std::min(4.0, norm(places[n] - places[0]) / 3), 0.5);
  }
  EXPECT_EQ((*bands)[0][0], 1);
  // Bands 0 to b add up to a brush that fades over the distance to band b + 1.
  std::vector<double> sums(places.size());
  for (int b = 0; b < 4; ++b) {
    const auto shares = painted(hill(), around(places[0], 3 * b, 3, false));
    for (std::size_t n = 0; n < places.size(); ++n)
      EXPECT_NEAR(sums[n] += (*bands)[b][n], shares[n], 1e-12) << b;
  }
  EXPECT_FALSE(paintBands(hill(), around(places[0], 1, 0, false), 5));
  EXPECT_FALSE(paintBands(hill(), around({1e6, 0, 0}, 0, 12, false), 5)) << "reaches nothing";
  Brush named = around(places[0], 0, 12, false);
  named.nodes = {{"n1", 1}};
  EXPECT_FALSE(paintBands(hill(), named, 5));
}

// ---- Shares ----

TEST(Regions, SharesSumToOne) {
  for (const Rig* rig : {&hill(), &ball()}) {
    const auto regions = someRegions(*rig);
    ASSERT_EQ(regions.size(), 4u);
    EXPECT_EQ(regions[0].name, "rest");
    const auto influences = influencesOf(rig->surface, regions);
    ASSERT_EQ(influences.size(), 4u);
    for (Index v = 0; v < rig->surface.storedCount(); ++v) {
      double sum = 0;
      for (const auto& region : influences) {
        EXPECT_TRUE(region[v] >= 0 && region[v] <= 1);
        sum += region[v];
      }
      EXPECT_NEAR(sum, 1, 1e-7);
    }
  }
}

TEST(Regions, WithNothingLeftThereIsNoRest) {
  const std::size_t nodes = hill().surface.wireframe().nodes.size();
  const auto regions =
      dividedFace(hill(), {{"a", {}, std::vector(nodes, 1.0)}, {"b", {}, std::vector(nodes, 0.5)}});
  ASSERT_TRUE(regions);
  ASSERT_EQ(regions->size(), 2u);
  EXPECT_NEAR((*regions)[1].shares[0], 1.0 / 3, 1e-15);
}

TEST(Regions, AreAtMost32WithTheRest) {
  const std::size_t nodes = hill().surface.wireframe().nodes.size();
  const auto divided = [&](std::size_t count, double share) {
    std::vector<Region> regions;
    for (std::size_t r = 0; r < count; ++r)
      regions.push_back({std::to_string(r), {}, std::vector(nodes, share)});
    return dividedFace(hill(), std::move(regions));
  };
  EXPECT_EQ(divided(32, 1).value().size(), 32u);
  EXPECT_EQ(divided(31, 0.01).value().size(), 32u);
  EXPECT_FALSE(divided(32, 0.01));
  EXPECT_FALSE(divided(33, 1));
}

TEST(Regions, RefuseWhatCannotBe) {
  const std::size_t nodes = hill().surface.wireframe().nodes.size();
  const std::vector<double> all(nodes, 1.0);
  const auto refuses = [&](std::vector<Region> regions) { return !dividedFace(hill(), regions); };
  EXPECT_TRUE(refuses({{"", {}, all}}));
  EXPECT_TRUE(refuses({{"a", {}, all}, {"a", {}, all}}));
  EXPECT_TRUE(refuses({{"a", {}, {1}}}));
  EXPECT_TRUE(refuses({{"a", {}, std::vector(nodes, 1.5)}}));
  EXPECT_TRUE(refuses({{"a", {}, std::vector(nodes, std::nan(""))}}));
  EXPECT_TRUE(refuses({{"a", {0, 1, 0}, all}}));
  EXPECT_TRUE(refuses({{"a", {1, 1, -1}, all}}));
  EXPECT_TRUE(refuses({{"a", {1, 1, 61}, all}}));
  EXPECT_FALSE(refuses({{"a", {1, 1, 60}, all}}));
  const auto nowhere = paint(hill(), Brush{});
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("says nowhere where it is"), std::string::npos);
}

// ---- Blending ----

TEST(Regions, OneRegionChangesNoBit) {
  const Rig& rig = hill();
  const auto regions = dividedFace(rig, {});
  ASSERT_TRUE(regions);
  EXPECT_TRUE(influencesOf(rig.surface, *regions).empty());
  const auto weights = anyWeights(rig.targets.size());
  EXPECT_EQ(blended(rig, *regions, weights), blend(rig, weights));
}

TEST(Regions, EqualWeightsAreThePlainBlend) {
  for (const Rig* rig : {&hill(), &ball()}) {
    const auto regions = someRegions(*rig);
    const auto plain = anyWeights(rig->targets.size());
    std::vector<double> weights;
    for (std::size_t r = 0; r < regions.size(); ++r)
      weights.insert(weights.end(), plain.begin(), plain.end());
    const auto a = blended(*rig, regions, weights), b = blend(*rig, plain);
    EXPECT_EQ(a, b);
  }
}

TEST(Regions, JoinsStayC2AndClosed) {
  for (const Rig* rig : {&hill(), &ball()}) {
    const auto regions = someRegions(*rig);
    const auto vectors = blended(*rig, regions, anyWeights(regions.size() * rig->targets.size()));
    int smooth = 0;
    for (const JoinReport& join : examineJoins(rig->surface, vectors)) {
      EXPECT_LE(join.positionGap, 1e-12);
      if (join.joinClass != JoinClass::c2) continue;
      ++smooth;
      EXPECT_LE(join.firstJump, 1e-12);
      EXPECT_LE(join.secondJump, 1e-12);
    }
    EXPECT_GT(smooth, 0);
  }
}

TEST(Regions, AnEvaluatorBlendsThemAlike) {
  for (const Rig* rig : {&hill(), &ball()}) {
    const auto regions = someRegions(*rig);
    EvaluatorOptions options;
    options.influences = influencesOf(rig->surface, regions);
    const auto evaluator = Evaluator::make(*rig, options);
    ASSERT_TRUE(evaluator);
    const auto weights = anyWeights(regions.size() * rig->targets.size());
    std::vector<float> positions(3 * evaluator->vertexCount());
    std::vector<std::byte> scratch(evaluator->scratchBytes());
    Evaluation frame;
    frame.evaluator = &*evaluator;
    frame.weights = weights;
    frame.scratch = scratch;
    frame.positions = {positions.data(), evaluator->vertexCount()};
    ASSERT_TRUE(frame.validate());
    frame.run();
    const auto exact = sourcePositions(*rig, Tessellation(rig->surface, 1),
                                       blended(*rig, regions, weights), weights);
    for (std::size_t v = 0; v < exact.size(); ++v) {
      const Vec3 found{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
      EXPECT_LE(norm(found - exact[v]), evaluator->positionBound(weights));
    }
  }
}

// ---- Parts as targets ----

TEST(Regions, OfTargetsThatAreStillToComeMoveNothing) {
  Rig rig = hill();
  const auto regions = someRegions(rig);
  rig.targets[0].difference.clear();
  auto weights = anyWeights(regions.size() * rig.targets.size());
  const auto without = blended(rig, regions, weights);
  for (std::size_t k = 0; k < weights.size(); k += rig.targets.size()) weights[k] = 0;
  EXPECT_EQ(blended(rig, regions, weights), without);
}

TEST(Regions, PartsOfTargetsHaveNamesOfTheirOwn) {
  Rig rig = hill();
  auto regions = someRegions(rig);
  regions[0].name = "rest", regions[1].name = "rest_";
  rig.targets[1].name = partName(rig.targets[0].name, "rest");
  RegionalTargets::addTo(rig, regions, std::vector<Index>{0});
  std::set<std::string> names;
  for (const Target& target : rig.targets) names.insert(target.name);
  EXPECT_EQ(names.size(), rig.targets.size());
}

TEST(Regions, PartsOfTargetsAddUpToTheSamePose) {
  for (const Rig* original : {&hill(), &ball()}) {
    Rig rig = *original;
    rig.source.loose = {{1, 2, 3}};  // on no face: moves as in the first region
    for (Target& target : rig.targets) target.looseDifference = {{1, 1, 0}};
    const Rig before = rig;
    const auto regions = someRegions(rig);
    const std::size_t count = rig.targets.size();
    const auto targets = RegionalTargets::addTo(rig, regions, std::vector<Index>{0, 1});
    EXPECT_GE(rig.find(partName(rig.targets[0].name, "a")), 0);
    EXPECT_GE(rig.find(partName(rig.targets[0].name, "rest")), 0);
    const auto weights = anyWeights(regions.size() * count);
    std::vector<double> all(rig.targets.size());
    targets.spread(weights, all);
    const auto a = blend(rig, all), b = blended(before, regions, weights);
    for (std::size_t v = 0; v < a.size(); ++v) EXPECT_LE(norm(a[v] - b[v]), 1e-12);
    const auto first = std::span(weights).first(count);
    EXPECT_LE(norm(blendLoose(rig, all)[0] - blendLoose(before, first)[0]), 1e-12);
    // No part has a negative weight: some programs clamp at 0.
    for (std::size_t k = count; k < all.size(); ++k) EXPECT_GE(all[k], 0);
    const auto wholes = targets.wholes();
    ASSERT_EQ(wholes.size(), rig.targets.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Target& whole = rig.targets[wholes[k]];
      EXPECT_TRUE(k < count ? whole == rig.targets[k]
                            : rig.targets[k].name.starts_with(partName(whole.name, "")));
    }
    // The whole targets themselves are unchanged.
    EXPECT_EQ(rig.targets[0], before.targets[0]);
  }
}

TEST(Regions, ATargetThatMovesOneRegionHasTheWeightOfThatRegion) {
  Rig rig = makeRig(twoPatches());
  for (Index v = 0; v < rig.surface.storedCount(); ++v)
    rig.targets[0].difference[v] = {rig.surface.stored(v).node == 0 ? 1.0 : 0, 0, 0};
  const std::vector<Region> regions{{"rest", {}, {0, 0, 1, 1, 1, 1}},
                                    {"a", {}, {0, 1, 0, 0, 0, 0}},
                                    {"b", {}, {1, 0, 0, 0, 0, 0}}};
  const std::size_t count = rig.targets.size();
  const auto targets = RegionalTargets::addTo(rig, regions, std::vector<Index>{0});
  ASSERT_EQ(rig.targets.size(), count) << "it needs no parts";
  std::vector<double> weights(regions.size() * count), all(count);
  weights[0] = 0.25, weights[count] = 0.5, weights[2 * count] = 0.75;
  targets.spread(weights, all);
  EXPECT_EQ(all[0], 0.75);
}

TEST(Regions, PartsThatNobodySeesMoveAreLeftOut) {
  const std::vector<Region> regions{{"a", {}, {1, 0, 0, 0, 0, 0}},
                                    {"rest", {}, {0, 1, 1, 1, 1, 1}}};
  for (const auto& [tolerances, isKept] : {std::pair{0.5, true}, {5e-4, false}}) {
    Rig rig = makeRig(twoPatches());
    for (Index v = 0; v < rig.surface.storedCount(); ++v)
      if (rig.surface.stored(v).node == 0)
        rig.targets[0].difference[v] = {tolerances * rig.tolerance, 0, 0};
    RegionalTargets::addTo(rig, regions, std::vector<Index>{0});
    EXPECT_EQ(rig.find(partName(rig.targets[0].name, "a")) >= 0, isKept) << tolerances;
  }
}

}  // namespace
}  // namespace sweepface
