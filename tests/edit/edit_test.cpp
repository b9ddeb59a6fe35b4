#include "sweepface/edit.hpp"

#include <numbers>

#include "sweepface/codec.hpp"

#include "codec/files.hpp"
#include "drawing/drawings.hpp"
#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Rig sheet() {
  std::ifstream file(std::string(SWEEPFACE_SOURCE_DIR) + "/examples/sheet.wire.json");
  return made(Json::parse(file));
}

/// A rig of any surface, with one target.
Rig rigOf(const Surface& surface) {
  Rig rig;
  rig.surface = surface;
  const auto stored = [&](Index from) {
    auto pose = anyPose(surface, from);
    pose.resize(static_cast<std::size_t>(surface.storedCount()));
    return pose;
  };
  rig.neutral = stored(0);
  rig.targets = {{"other", stored(7), {}}};
  return rig;
}

std::vector<Vec3> poseOf(const Rig& rig) { return blend(rig, Weights(rig.targets.size(), 0.75)); }

/// The largest displacement in each patch; 0 only if all bits are the same.
std::vector<double> moved(const Rig& before, const Rig& after) {
  const auto x = poseOf(before), y = poseOf(after);
  std::vector<double> result(static_cast<std::size_t>(before.surface.patchCount()));
  for (Index p = 0; p < before.surface.patchCount(); ++p)
    for (const Site& site : sitesOf(before.surface, p)) {
      const Vec3 a = before.surface.evaluate(x, site), b = after.surface.evaluate(y, site);
      if (!(a == b))
        result[p] = std::max({result[p], norm(b - a), std::numeric_limits<double>::min()});
    }
  return result;
}

::testing::AssertionResult movesOnly(const Patches& changed, const Rig& before, const Rig& after) {
  const auto by = moved(before, after);
  for (Index p = 0; p < before.surface.patchCount(); ++p)
    if (by[p] > 0 && !std::ranges::binary_search(changed, p))
      return ::testing::AssertionFailure() << "patch " << p << " moved by " << by[p];
  return ::testing::AssertionSuccess();
}

std::set<std::string> names(const Rig& rig, const Patches& patches) {
  std::set<std::string> result;
  for (Index p : patches) result.insert(rig.nameOf(Thing::patch, p));
  return result;
}

const std::set<std::string> kMiddleRow{"a1 b2", "b1 c2", "c1 d2"};

TEST(ShapeParameters, AThousandTimesAsLargeChangeTheirRibbonVisiblyAndNothingElse) {
  const Rig before = sheet();
  const Index ribbon = before.find(Thing::ribbon, "middle").value();
  const Shape shape = before.surface.wireframe().ribbons[ribbon];
  ASSERT_EQ(shape, (Shape{1, -0.1, 0.01}));
  for (const Shape& other : {Shape{1, -100, 0.01}, Shape{1, -0.1, 10}}) {
    Rig after = before;
    const auto changed = setShape(after, ribbon, other);
    ASSERT_TRUE(changed);
    EXPECT_EQ(names(after, *changed), kMiddleRow);
    EXPECT_TRUE(movesOnly(*changed, before, after));
    for (Index p : *changed) EXPECT_GT(moved(before, after)[p], 0.05);  // of 3 × 3
  }
}

TEST(ShapeParameters, BesideAResonanceAreRefusedAndChangeNothing) {
  Rig rig = sheet();
  const Wireframe before = rig.surface.wireframe();
  const Index ribbon = rig.find(Thing::ribbon, "middle").value();
  const auto refused = setShape(rig, ribbon, {1, 80.7836 / 64, 1.0 / 4096});  // sides of 8 edges
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("Ribbon 'middle' cannot have these parameters"),
            std::string::npos);
  EXPECT_EQ(rig.surface.wireframe().ribbons, before.ribbons);
}

TEST(ControlCurves, MoveByWhatIsAskedAndTheSurfaceBendsBesideThem) {
  const Rig before = sheet();
  Rig after = before;
  const Index curve = before.find(Thing::curve, "b1-c1").value(),
              patch = before.find(Thing::patch, "b1 c2").value();
  const ControlMove move{curve, patch, {0.02, 0.15, 0}, {0, 0.45, -0.1}};
  const auto changed = moveControls(after, move);
  ASSERT_TRUE(changed);
  EXPECT_TRUE(movesOnly(*changed, before, after));
  EXPECT_EQ(names(after, *changed),
            (std::set<std::string>{"a0 b1", "b0 c1", "c0 d1", "a1 b2", "b1 c2", "c1 d2"}));
  EXPECT_GT(moved(before, after)[patch], 0.1);

  // The curve itself stays; the controls beside it are the parabola of the derivatives across.
  const auto x = poseOf(before), y = poseOf(after);
  const double edges = 8;
  for (double along : {0.0, 2.5, 8.0}) {
    const Site site{patch, 0, along};  // the patch sweeps away from the curve
    EXPECT_LT(norm(after.surface.evaluate(y, site) - before.surface.evaluate(x, site)), 1e-12);
    for (const auto& [share, by] :
         {std::pair(kControlSpacing.u2, move.second), std::pair(kControlSpacing.u3, move.third)}) {
      Vec3 offset;
      const double h = share * edges;
      for (int order = 1; order <= 2; ++order) {
        const Vec3 change =
            after.surface.evaluate(y, site, order, 0) - before.surface.evaluate(x, site, order, 0);
        offset += change * (order == 1 ? h : h * h / 2);
      }
      EXPECT_LT(norm(offset - by), 1e-9) << along << ' ' << share;
    }
  }
}

/// Three sheets around a node 'o', from which their first sides 's0' to 's2' leave.
Json star() {
  Json drawing = {{"format", "sweepface wireframe 1"},
                  {"nodes", {{{"name", "o"}, {"at", {0, 0, 0.3}}}}}};
  const auto at = [&](const std::string& name, double radius, double degrees, double z) {
    const double angle = degrees * std::numbers::pi / 180;
    drawing["nodes"].push_back(
        {{"name", name}, {"at", {radius * std::cos(angle), radius * std::sin(angle), z}}});
  };
  const auto curve = [&](const std::string& name, const std::string& from, const std::string& to) {
    drawing["curves"].push_back({{"name", name}, {"from", from}, {"to", to}, {"edges", 8}});
  };
  for (int k = 0; k < 3; ++k) {
    const std::string one = std::to_string(k), next = std::to_string((k + 1) % 3);
    at("a" + one, 1, 120 * k, 0.15);
    at("b" + one, 1.4, 120 * k + 60, 0);
    curve("s" + one, "o", "a" + one);
    curve("t" + one, "a" + one, "b" + one);
    curve("u" + one, "b" + one, "a" + next);
    drawing["patches"].push_back(
        {{"name", "p" + one}, {"sides", {"s" + one, "t" + one, "u" + one, "-s" + next}}});
  }
  return drawing;
}

// Where the few vectors of the node cannot produce the move, the curves must not be thrown far off.
TEST(ControlCurves, BesideASpokeMoveAboutAsAsked) {
  const Rig before = made(star());
  Rig after = before;
  const Index patch = before.find(Thing::patch, "p0").value();
  const Vec3 by{0, 0, 0.1};
  ASSERT_TRUE(moveControls(after, {before.find(Thing::curve, "s0").value(), patch, by, {}}));
  const auto x = poseOf(before), y = poseOf(after);
  double second = 0, third = 0;
  for (double along = 0; along <= 8; along += 0.5) {
    const Site site{patch, along, 0};
    std::array<Vec3, 3> change;
    for (int order = 0; order < 3; ++order)
      change[order] =
          after.surface.evaluate(y, site, 0, order) - before.surface.evaluate(x, site, 0, order);
    EXPECT_LT(norm(change[0]), 1e-11 * norm(by));
    const auto [two, three] =
        controlsFromDerivatives(change[0], {8 * change[1], 64 * change[2]}, kControlSpacing);
    second = std::max(second, norm(two - by)), third = std::max(third, norm(three));
  }
  EXPECT_LT(second, 0.6 * norm(by));
  EXPECT_LT(third, 0.3 * norm(by));
}

TEST(ControlCurves, OfAnotherPatchOrWithoutLengthAreRefused) {
  Rig rig = sheet();
  const auto refused = moveControls(rig, {rig.find(Thing::curve, "a0-b0").value(),
                                          rig.find(Thing::patch, "b1 c2").value(),
                                          {0, 1, 0},
                                          {0, 2, 0}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "Curve 'a0-b0' does not bound patch 'b1 c2'; name a patch on either side of it.");
}

TEST(ControlCurves, BesideAClosedCurveMoveOnce) {
  const Rig before = made(tube());
  Rig after = before;
  const Index foot = before.find(Thing::curve, "foot").value();
  ASSERT_TRUE(moveControls(after, {foot, 0, {0, 0.25, 0}, {0, 0.625, 0}}));
  double most = 0;
  for (Index v = 0; v < before.surface.storedCount(); ++v)
    most = std::max(most, norm(after.neutral[v] - before.neutral[v]));
  // The moves of the controls, at 0.1 and 0.25 of the way across, are linear: 2.5 for all of it.
  EXPECT_NEAR(most, 2.5 / before.surface.edgesU(0), 1e-9);
}

TEST(ControlCurves, TowardsAPoleLeaveItAsItIs) {
  const Rig before = rigOf(Surface::make(fan(4)).value());
  Rig after = before;
  ASSERT_TRUE(moveControls(after, {1, 0, {0, 0, 0.1}, {0, 0, 0.2}}));
  for (Index v = 0; after.surface.stored(v).node == 0; ++v)
    EXPECT_EQ(after.neutral[v], before.neutral[v]) << v;
}

TEST(Nodes, AtOnePointMoveTogether) {
  Json drawing = square();  // and another one that touches it at a corner
  drawing["nodes"].push_back({{"name", "e"}, {"with", "c"}});
  for (const auto& [name, x, y] : {std::tuple{"f", 8, 4}, {"g", 8, 8}, {"h", 4, 8}})
    drawing["nodes"].push_back({{"name", name}, {"at", {x, y, 0}}});
  for (const auto& [from, to] : {std::pair{"e", "f"}, {"f", "g"}, {"g", "h"}, {"h", "e"}})
    drawing["curves"].push_back({{"name", std::string(from) + to}, {"from", from}, {"to", to}});
  drawing["patches"].push_back({{"name", "other"}, {"sides", {"ef", "fg", "gh", "he"}}});
  Rig rig = made(drawing);
  ASSERT_TRUE(moveNodes(rig, std::array{NodeMove{rig.find(Thing::node, "c").value(), {0, 0, 5}}}));
  EXPECT_LT(norm(middleOf(rig, "bc", 1) - Vec3{4, 4, 5}), 1e-12);
  EXPECT_LT(norm(middleOf(rig, "ef", 0) - Vec3{4, 4, 5}), 1e-12);

  drawing["expressions"] =
      Json::parse(R"([{"name": "torn", "moves": {"c": [0, 0, 1], "e": [0, 0, 2]}}])");
  const auto torn = buildJson(drawing);
  ASSERT_FALSE(torn);
  EXPECT_NE(torn.error().message.find("are one point and cannot move"), std::string::npos);
}

TEST(Nodes, TakeWhatMeetsThereAlong) {
  const Rig before = sheet();
  Rig after = before;
  const NodeMove move{before.find(Thing::node, "b1").value(), {0, 0.3, 0}};
  const auto changed = moveNodes(after, std::array{move});
  ASSERT_TRUE(changed);
  EXPECT_EQ(names(after, *changed), (std::set<std::string>{"a0 b1", "b0 c1", "a1 b2", "b1 c2"}));
  EXPECT_TRUE(movesOnly(*changed, before, after));
  EXPECT_GT(moved(before, after)[changed->front()], 0.1);
}

TEST(Nodes, OfACurveAreWhereItBeginsAndWhereItEnds) {
  const Rig rig = sheet();
  EXPECT_EQ(
      endsOf(rig, rig.find(Thing::curve, "b1-c1").value()).value(),
      (std::vector{rig.find(Thing::node, "b1").value(), rig.find(Thing::node, "c1").value()}));
}

TEST(Nodes, ListedTwiceMoveOnce) {
  Rig once = sheet(), twice = sheet();
  const NodeMove move{once.find(Thing::node, "b1").value(), {0, 0.3, 0}};
  ASSERT_TRUE(moveNodes(once, std::array{move}));
  ASSERT_TRUE(moveNodes(twice, std::array{move, move}));
  EXPECT_EQ(once.neutral, twice.neutral);
  const auto torn = moveNodes(twice, std::array{move, NodeMove{move.node, {1, 0, 0}}});
  ASSERT_FALSE(torn);
  EXPECT_EQ(torn.error().message,
            "Nodes 'b1' and 'b1' are one point and cannot move to different places.");
}

TEST(EveryEdit, OfWhatThereIsNotIsRefused) {
  Rig rig = sheet();
  const double nan = std::nan("");
  EXPECT_EQ(setShape(rig, 1000, {}).error().message.substr(0, 24), "There is no ribbon 1000;");
  EXPECT_FALSE(setShape(rig, -1, {}));
  EXPECT_FALSE(moveNodes(rig, std::array{NodeMove{1000, {}}}));
  EXPECT_FALSE(moveNodes(rig, std::array{NodeMove{0, {}}}, 1000));
  EXPECT_FALSE(moveNodes(rig, std::array{NodeMove{0, {0, nan, 0}}}));
  EXPECT_FALSE(moveControls(rig, {1000, 0, {}, {}}));
  EXPECT_FALSE(moveControls(rig, {0, -1, {}, {}}));
  EXPECT_FALSE(moveControls(rig, {0, 0, {}, {}}, 1000));
  EXPECT_FALSE(endsOf(rig, 1000));
  for (const ControlMove& move : {ControlMove{0, 0, {nan, 0, 0}, {}}, {0, 0, {}, {nan, 0, 0}}})
    EXPECT_EQ(moveControls(rig, move).error().message,
              "A control curve cannot move by what is not finite.");
}

/// At a node where two patches meet, no stored vector moves the derivatives.
TEST(ControlCurves, MoveWhatThereIsToMove) {
  const Rig before = rigOf(Surface::make(wheel(2, {})).value());
  Rig after = before;
  const auto changed = moveControls(after, {0, 0, {0, 0, 0.1}, {}});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_FALSE(changed->empty());
  EXPECT_TRUE(movesOnly(*changed, before, after));
}

TEST(EveryEdit, WaitsForTheTargets) {
  Rig rig = sheet();
  rig.targets.push_back({"to come", {}, {}});
  const Rig before = rig;
  const std::string why = "The targets of the face are not decoded yet";
  const Index patch = 0, curve = arcOf(rig.surface.wireframe().side(patch, 0)[0]);
  for (const auto& edit :
       {setShape(rig, 0, {2, 0, 0}), moveNodes(rig, std::vector<NodeMove>{{0, {1, 0, 0}}}),
        moveNodes(rig, std::vector<NodeMove>{{0, {1, 0, 0}}}, 0),
        moveControls(rig, {curve, patch, {1, 0, 0}, {}})}) {
    ASSERT_FALSE(edit);
    EXPECT_TRUE(edit.error().message.starts_with(why)) << edit.error().message;
  }
  EXPECT_EQ(rig.neutral, before.neutral);
}

TEST(EveryEdit, OfATargetMovesInItAlone) {
  Rig before = sheet();
  before.targets = rigOf(before.surface).targets;
  Rig nodes = before, controls = before;
  const Index curve = before.find(Thing::curve, "b1-c1").value(),
              patch = before.find(Thing::patch, "b1 c2").value();
  ASSERT_TRUE(moveNodes(nodes, std::array{NodeMove{0, {1, 2, 3}}}, 0));
  ASSERT_TRUE(moveControls(controls, {curve, patch, {1, 2, 3}, {}}, 0));
  for (const Rig* after : {&nodes, &controls}) {
    EXPECT_EQ(after->neutral, before.neutral);
    EXPECT_NE(after->targets[0].difference, before.targets[0].difference);
  }
}

// The reference that targets are relative to does not change. (Where nodes store more, the
// predictors of the others may still change, but not beside curve 3.)
TEST(EveryEdit, LeavesTheTargetsOfAPackedFaceSmall) {
  const Rig before = decode(goldenFile("golden_sample.sweep"), "sample").value();
  Rig nodes = before, controls = before;
  ASSERT_TRUE(moveNodes(nodes, std::array{NodeMove{0, {0.3, 0.2, 0.4}}}));
  ASSERT_TRUE(moveControls(controls, {3, 0, {0.1, 0.2, 0.3}, {}}));
  for (const Rig* after : {&nodes, &controls})
    EXPECT_LT(encode(*after).size(), 2 * encode(before).size());
}

// Whatever the wireframe: T-nodes, irregular nodes, creases, collapsed sides.
TEST(EveryEdit, TellsAllPatchesThatItMoves) {
  int edits = 0, refused = 0;
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const Rig before = rigOf(surface);
    const auto expectLocal = [&](const Result<Patches>& changed, const Rig& after) {
      ++edits;
      if (!changed) {
        ++refused;
        EXPECT_EQ(after.neutral, before.neutral);
        return;
      }
      EXPECT_TRUE(movesOnly(*changed, before, after));
    };
    const auto step = [](std::size_t count) { return static_cast<Index>(1 + count / 8); };
    const Wireframe& w = surface.wireframe();
    for (Index r = 0; r < std::ssize(w.ribbons); r += step(w.ribbons.size())) {
      Rig after = before;
      expectLocal(setShape(after, r, {1, -3, 0.5}), after);
    }
    for (Index n = 0; n < std::ssize(w.nodes); n += step(w.nodes.size())) {
      Rig after = before;
      expectLocal(moveNodes(after, std::array{NodeMove{n, {0.5, -1, 2}}}), after);
    }
    for (HalfArc h = 0; h < 2 * std::ssize(w.arcs); h += step(2 * w.arcs.size())) {
      const Index patch = surface.connectivity().patchOf[h];
      if (patch < 0) continue;
      Rig after = before;
      expectLocal(moveControls(after, {arcOf(h), patch, {0.1, 0, 0}, {0, 0.2, 0}}), after);
    }
  }
  EXPECT_GT(edits, 100);
  EXPECT_LT(refused, edits / 2);
}

}  // namespace
}  // namespace sweepface
