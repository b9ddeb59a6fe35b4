#include <gtest/gtest.h>
#include <vector>

#include "sweepface/head.hpp"
#include "sweepface/live_motion.hpp"
#include "sweepface/motion.hpp"
#include "sweepface/regional_motion.hpp"

#include "allocations.hpp"

namespace sweepface {
namespace {

using testing::allocations;

TEST(Motion, EvaluatesWithoutAllocating) {
  if (!testing::watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const std::vector<double> from(50, 0.0), to(50, 1.0);
  std::vector<double> out(50);
  for (const TimeLaw law : timeLaws) {
    const std::size_t before = allocations.count;
    const Result<Motion> motion = Motion::make(from, to, law, 1);
    const std::size_t made = allocations.count;
    EXPECT_GT(made, before);  // the counter works
    motion->at(0.3, out);
    motion->velocities(0.3, out);
    motion->forces(0.3, out);
    EXPECT_EQ(allocations.count, made);
  }
}

TEST(Clip, IsReadWithoutAllocating) {
  if (!testing::watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const Clip clip{{"jawOpen", "HeadYaw"}, {0, 1}, {0, 0, 1, 0.5}};
  const ClipMatch match = matchClip(clip, std::vector<std::string>{"jawOpen"});
  const ClipAngles angles(clip);
  std::vector<double> out(1);
  const std::size_t before = allocations.count;
  match.spread(clip, 0.5, out);
  EXPECT_EQ(angles.at(clip, 0.5).head.yaw, -0.25);
  EXPECT_EQ(allocations.count, before);
  EXPECT_EQ(out[0], 0.5);
}

TEST(MotionState, MovesWithoutAllocating) {
  Result<MotionState> state = MotionState::make(std::vector<double>(57, 0.0));
  const std::vector<double> goals(57, 1.0);
  std::vector<double> out(57);
  const std::size_t before = allocations.count;
  for (int frame = 0; frame < 100; ++frame) {
    state->advance(1.0 / 60);
    ASSERT_TRUE(state->moveTo(goals));
    ASSERT_TRUE(state->push(3, 0.1, 1));
    state->positions(out);
    state->velocities(out);
  }
  EXPECT_EQ(allocations.count, before);
}

TEST(RegionalMotion, MovesLateRegionsWithoutAllocating) {
  auto motion = RegionalMotion::make(std::vector<double>(57, 0.0),
                                     std::vector<Matter>{{1, 1, 0}, {3, 1, 0.1}, {1, 1, 5}});
  const std::vector<double> goals(57, 1.0);
  std::vector<double> out(3 * 57);
  const std::size_t before = allocations.count;
  for (int frame = 0; frame < 600; ++frame) {
    motion->advance(1.0 / 60);
    ASSERT_TRUE(motion->moveTo(goals));
    ASSERT_TRUE(motion->push(3, 0.1, 1));
    ASSERT_TRUE(frame % 100 > 0 || motion->put(2, 7, 0.5));
    motion->positions(out);
    motion->velocities(out);
  }
  EXPECT_EQ(allocations.count, before);
}

}  // namespace
}  // namespace sweepface
