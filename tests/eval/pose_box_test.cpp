#include "sweepface/pose_box.hpp"

#include <random>

#include "codec/rigs.hpp"
#include "eval/play.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Box boxOf(const std::vector<float>& positions) {
  Box box;
  for (std::size_t v = 0; v < positions.size() / 3; ++v) box.include(vectorOf(positions, v));
  return box;
}

bool contains(const Box& outer, const Box& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (coordinate(inner.low, axis) < coordinate(outer.low, axis) ||
        coordinate(inner.high, axis) > coordinate(outer.high, axis))
      return false;
  return true;
}

TEST(PoseBox, ContainsEveryPose) {
  std::mt19937 random(3);
  for (const Rig& rig : someRigs())
    for (const double size : {0.1, 1.0, 30.0, 1e6}) {
      const auto evaluator = Evaluator::make(rig, {.level = 2}).value();
      const PoseBox box(evaluator);
      std::uniform_real_distribution<double> weight(-size, size);
      for (int pose = 0; pose < 20; ++pose) {
        const std::vector<double> weights = {weight(random), pose % 3 ? weight(random) : 0,
                                             weight(random)};
        EXPECT_TRUE(contains(box.of(weights), boxOf(play(evaluator, weights).positions)));
        Box exact;
        for (const Vec3& p : Tessellation(rig.surface, 2).positions(blend(rig, weights)))
          exact.include(p);
        EXPECT_TRUE(contains(box.of(weights), exact));
      }
    }
}

TEST(PoseBox, IsThatOfTheNeutralAndOfHowFarATargetMovesAnything) {
  for (const Rig& rig : someRigs()) {
    const auto evaluator = Evaluator::make(rig, {.level = 2}).value();
    const PoseBox box(evaluator);
    const std::vector<double> weights = {1};
    const auto still = play(evaluator, {}).positions, moved = play(evaluator, weights).positions;
    Box ways;
    for (std::size_t v = 0; v < still.size() / 3; ++v)
      ways.include(vectorOf(moved, v) - vectorOf(still, v));
    const double bound = 14 * evaluator.positionBound(weights);  // eight bounds on each axis
    EXPECT_LE(norm(box.of({}).size() - boxOf(still).size()), bound);
    EXPECT_LE(norm(box.of(weights).size() - (boxOf(still).size() + ways.size())), bound);
    const std::vector<double> back = {-2};
    EXPECT_LE(norm(box.of(back).size() - (boxOf(still).size() + 2 * ways.size())), 2 * bound);
  }
}

TEST(PoseBox, MovesWithATargetThatMovesAll) {
  Rig rig = someRigs().front();
  const Vec3 way{3, -4, 5};
  for (Index v = 0; v < rig.surface.storedCount(); ++v) {
    const StoredVector& stored = rig.surface.stored(v);
    rig.targets[0].difference[v] = stored.i == 0 && stored.j == 0 ? way : Vec3{};
  }
  const auto evaluator = Evaluator::make(rig).value();
  const PoseBox box(evaluator);
  const double bound = 5 * evaluator.positionBound(std::vector{2.0});
  const Box still = box.of({}), moved = box.of(std::vector{2.0});
  EXPECT_LE(norm(moved.low - (still.low + 2 * way)), bound);
  EXPECT_LE(norm(moved.high - (still.high + 2 * way)), bound);
}

TEST(PoseBox, IsEmptyWithoutVertices) {
  const Rig rig = someRigs().front();
  const auto evaluator =
      Evaluator::make(rig, Tessellation(rig.surface, std::vector<Site>{}), {.level = 1}).value();
  EXPECT_TRUE(PoseBox(evaluator).of(std::vector{1.0}).isEmpty());
}

}  // namespace
}  // namespace sweepface
