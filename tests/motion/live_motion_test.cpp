#include "sweepface/live_motion.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace sweepface {
namespace {

constexpr std::array kKinds{Drive::Kind::newton, Drive::Kind::linearForce,
                            Drive::Kind::accelerateBrake, Drive::Kind::spring, Drive::Kind::bounce};

MotionState still(std::size_t count) { return *MotionState::make(std::vector<double>(count, 0.0)); }

Drive drive(Drive::Kind kind, double seconds = 0.4) {
  return {.kind = kind, .seconds = seconds, .spring = {}};
}

void expectNoJumpAfter(MotionState& state, double seconds) {
  state.advance(seconds - 1e-12);
  const Kinematics before = state.sample(0);
  state.advance(2e-12);
  const Kinematics after = state.sample(0);
  EXPECT_NEAR(before.position, after.position, 1e-9);
  EXPECT_NEAR(before.velocity, after.velocity, 1e-9);
}

TEST(MotionState, InterruptedAtAnyMomentItDoesNotJump) {
  std::mt19937 engine(3);
  std::uniform_real_distribution unit(0.0, 1.0);
  MotionState state = still(1);
  for (int i = 0; i < 10'000; ++i) {
    state.advance(unit(engine));
    const Kinematics before = state.sample(0);
    Drive next = drive(kKinds[engine() % kKinds.size()], 0.1 + unit(engine));
    next.spring = {0.5 + 3 * unit(engine), 2 * unit(engine)};
    next.delay = i % 3 == 0 ? 0.3 * unit(engine) : 0;
    ASSERT_TRUE(state.moveTo(0, unit(engine), next));
    const Kinematics after = state.sample(0);
    ASSERT_NEAR(after.position, before.position, 1e-12 * (1 + std::abs(before.position))) << i;
    ASSERT_NEAR(after.velocity, before.velocity, 1e-12 * (1 + std::abs(before.velocity))) << i;
  }
}

TEST(MotionState, ADelayedDriveSetsOutWithoutAJump) {
  MotionState state = still(1);
  ASSERT_TRUE(state.moveTo(0, 1, drive(Drive::Kind::spring)));
  state.advance(0.05);
  Drive late = drive(Drive::Kind::linearForce);
  late.delay = 0.1;
  ASSERT_TRUE(state.moveTo(0, 0, late));
  expectNoJumpAfter(state, 0.1);
  state.advance(1);
  EXPECT_EQ(state.sample(0).position, 0);
}

TEST(MotionState, ADelayedDriveInPlaceOfOneThatWaitsSetsOutWithoutAJump) {
  MotionState state = still(1);
  ASSERT_TRUE(state.moveTo(0, 1, drive(Drive::Kind::linearForce, 1)));
  Drive replaced = drive(Drive::Kind::cut), late = drive(Drive::Kind::newton);
  replaced.delay = 0.2;
  ASSERT_TRUE(state.moveTo(0, -5, replaced));
  late.delay = 0.4;
  ASSERT_TRUE(state.moveTo(0, 1, late));
  expectNoJumpAfter(state, 0.4);
}

TEST(MotionState, ADelayedDriveLeavesTimeToOneOfTheSameMoment) {
  MotionState state = still(1);
  Drive late = drive(Drive::Kind::cut);
  late.delay = 1;
  ASSERT_TRUE(state.moveTo(0, 1, drive(Drive::Kind::cut)));
  ASSERT_TRUE(state.moveTo(0, 0, late));
  state.advance(0.5);
  EXPECT_EQ(state.sample(0).position, 1);
  state.advance(0.5);
  EXPECT_EQ(state.sample(0).position, 0);
}

TEST(MotionState, TheFrameRateDoesNotMatter) {
  for (const Drive::Kind kind : kKinds) {
    MotionState coarse = still(1), fine = still(1);
    ASSERT_TRUE(coarse.moveTo(0, 1, drive(kind)));
    ASSERT_TRUE(fine.moveTo(0, 1, drive(kind)));
    coarse.advance(0.1);
    for (int i = 0; i < 100; ++i) fine.advance(0.001);
    EXPECT_NEAR(coarse.sample(0).position, fine.sample(0).position, 1e-13) << nameOf(kind);
    EXPECT_NEAR(coarse.sample(0).velocity, fine.sample(0).velocity, 1e-12) << nameOf(kind);
  }
}

TEST(MotionState, EveryWeightHasItsOwnDrive) {
  MotionState state = still(3);
  ASSERT_TRUE(state.moveTo(0, 1, drive(Drive::Kind::newton, 1)));
  ASSERT_TRUE(state.moveTo(1, 1, drive(Drive::Kind::cut)));
  state.advance(0.5);
  std::array<double, 3> x{}, v{};
  state.positions(x);
  state.velocities(v);
  EXPECT_EQ(x[0], 0.25);
  EXPECT_EQ(v[0], 1);
  EXPECT_EQ(x[1], 1);
  EXPECT_EQ(v[1], 0);
  EXPECT_EQ(x[2], 0);
}

TEST(MotionState, AllWeightsGoTogether) {
  MotionState state = still(2);
  const std::array goals{1.0, -1.0};
  ASSERT_TRUE(state.moveTo(goals, drive(Drive::Kind::accelerateBrake, 1)));
  state.advance(0.5);
  EXPECT_NEAR(state.sample(0).position, 0.5, 1e-15);
  EXPECT_NEAR(state.sample(1).position, -0.5, 1e-15);
}

TEST(MotionState, ABlowAddsVelocity) {
  MotionState state = still(1);
  ASSERT_TRUE(state.push(0, 2, 4));
  EXPECT_EQ(state.sample(0).velocity, 2);
  state.advance(100);
  EXPECT_NEAR(state.sample(0).position, 0.5, 1e-12);
}

TEST(MotionState, MovesWhileAnyWeightDoes) {
  MotionState state = still(3);
  EXPECT_FALSE(state.moves());
  ASSERT_TRUE(state.moveTo(1, 1, drive(Drive::Kind::newton, 0.5)));
  ASSERT_TRUE(state.moveTo(2, 1, {.kind = Drive::Kind::spring, .spring = {2, 1}}));
  EXPECT_TRUE(state.moves());
  state.advance(0.6);
  EXPECT_TRUE(state.moves());  // the spring
  while (state.moves(0.01)) state.advance(0.01);
  EXPECT_NEAR(state.sample(2).position, 1, 0.01);
  EXPECT_LT(state.now(), 1);
  EXPECT_TRUE(state.moves());
}

TEST(MotionState, MovesWhileAWeightWaitsToSetOut) {
  MotionState state = still(1);
  Drive late = drive(Drive::Kind::newton, 0.5);
  late.delay = 1;
  ASSERT_TRUE(state.moveTo(0, 1, late));
  state.advance(0.9);
  EXPECT_TRUE(state.moves(10));
  state.advance(0.3);
  EXPECT_TRUE(state.moves());
  state.advance(0.4);
  EXPECT_FALSE(state.moves());
}

TEST(MotionState, TimeNeverRunsBackwards) {
  MotionState state = still(1);
  state.advance(1);
  state.advance(-5);
  state.advance(std::numeric_limits<double>::quiet_NaN());
  state.advance(std::numeric_limits<double>::infinity());
  EXPECT_EQ(state.now(), 1);
}

TEST(MotionState, AStepOfAClockOfOtherUnitsIsNone) {
  MotionState state = still(1);
  state.advance(1.7e18);  // nanoseconds
  EXPECT_EQ(state.now(), 0);
  state.advance(kMostSeconds);
  ASSERT_TRUE(
      state.moveTo(0, 1, {.kind = Drive::Kind::accelerateBrake, .seconds = 1, .spring = {}}));
  for (int frame = 0; frame < 30; ++frame) state.advance(1.0 / 60);
  EXPECT_NEAR(state.sample(0).position, 0.5, 1e-3);
}

TEST(MotionState, RefusesWithoutChange) {
  MotionState state = still(2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(state.moveTo(2, 1));
  EXPECT_FALSE(state.moveTo(0, nan));
  EXPECT_FALSE(state.moveTo(0, nan, drive(Drive::Kind::cut)));
  Drive late = drive(Drive::Kind::spring);
  for (const double delay : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    late.delay = delay;
    EXPECT_FALSE(state.moveTo(0, 1, late)) << delay;
  }
  EXPECT_FALSE(state.moveTo(std::array{1.0}));
  EXPECT_FALSE(state.moveTo(std::array{1.0, nan}));
  EXPECT_FALSE(state.push(5, 1, 1));
  EXPECT_FALSE(MotionState::make(std::array{nan}));
  state.advance(1);
  EXPECT_EQ(state.sample(0).position, 0);
  EXPECT_EQ(state.sample(7).position, 0);
}

TEST(Drive, NamesGoBothWays) {
  EXPECT_EQ(driveFromName(nameOf(Drive::Kind::cut))->kind, Drive::Kind::cut);
  for (const Drive::Kind kind : kKinds) EXPECT_EQ(driveFromName(nameOf(kind))->kind, kind);
  EXPECT_NE(driveFromName("jump").error().message.find("accelerate-brake"), std::string::npos);
}

// Springs are evaluated together for speed; the results must be the same as one by one, to the bit.
TEST(MotionState, AllAtOnceIsEachAlone) {
  auto state = MotionState::make(std::vector<double>(5, 0.0));
  ASSERT_TRUE(state);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> positions(5), velocities(5);
  for (int k = 0; k < 5000; ++k) {
    Drive drive;
    drive.kind = static_cast<Drive::Kind>(random() % 6);
    drive.delay = random() % 3 == 0 ? 0.1 * uniform(random) : 0;
    drive.spring = {1 + uniform(random), random() % 2 == 0 ? 1 : uniform(random)};
    if (random() % 4 == 0) {
      ASSERT_TRUE(state->moveTo(std::vector<double>(5, uniform(random)), drive));
    } else {
      ASSERT_TRUE(state->moveTo(random() % 5, uniform(random), drive));
    }
    if (random() % 9 == 0) {
      ASSERT_TRUE(state->push(random() % 5, uniform(random), 3));
    }
    state->advance(random() % 2 == 0 ? 0.1 * uniform(random) : 0);
    state->positions(positions);
    state->velocities(velocities);
    for (std::size_t w = 0; w < positions.size(); ++w) {
      EXPECT_EQ(positions[w], state->sample(w).position);
      EXPECT_EQ(velocities[w], state->sample(w).velocity);
    }
  }
}

// All springs of a kind are restarted when another sets out. The motion must not depend on that,
// nor on how time is divided into steps.
TEST(MotionState, HoweverTimeIsCutSpringsAreInTheSamePlace) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr std::size_t kWeights = 6;
  MotionState whole = still(kWeights), cut = still(kWeights);
  for (int i = 0; i < 2000; ++i) {
    Drive next = drive(Drive::Kind::spring);
    next.spring = {random() % 2 == 0 ? 2.0 : 3.0, random() % 2 == 0 ? 1 : 0.4};
    next.delay = random() % 3 == 0 ? 0.2 * uniform(random) : 0;
    const std::size_t weight = random() % kWeights;
    const double goal = uniform(random), seconds = 0.1 * uniform(random);
    ASSERT_TRUE(whole.moveTo(weight, goal, next));
    ASSERT_TRUE(cut.moveTo(weight, goal, next));
    whole.advance(seconds);
    const double middle = seconds * uniform(random);
    cut.advance(middle);
    cut.advance(seconds - middle);
    for (std::size_t k = 0; k < kWeights; ++k) {
      ASSERT_NEAR(whole.sample(k).position, cut.sample(k).position, 1e-12) << i;
      ASSERT_NEAR(whole.sample(k).velocity, cut.sample(k).velocity, 1e-11) << i;
    }
  }
}

}  // namespace
}  // namespace sweepface
