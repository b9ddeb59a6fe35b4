#include "sweepface/regional_motion.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

#include "sweepface/timeline.hpp"

#include "greater.hpp"

namespace sweepface {
namespace {

Drive spring(double frequency, double damping) {
  Drive drive;
  drive.kind = Drive::Kind::spring;
  drive.spring = {frequency, damping};
  return drive;
}

RegionalMotion motionOf(const std::vector<double>& weights, const std::vector<Matter>& matters) {
  auto motion = RegionalMotion::make(weights, matters);
  EXPECT_TRUE(motion);
  return *motion;
}

TEST(RegionalMotion, OneRegionIsAMotionStateBitForBit) {
  const std::vector<double> weights{0.1, -0.4};
  RegionalMotion motion = motionOf(weights, {{}});
  auto state = MotionState::make(weights);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 500; ++k) {
    for (const auto kind : {Drive::Kind::spring, Drive::Kind::newton, Drive::Kind::linearForce,
                            Drive::Kind::accelerateBrake, Drive::Kind::bounce}) {
      Drive drive;
      drive.kind = kind;
      const double goal = uniform(random);
      ASSERT_TRUE(motion.moveTo(1, goal, drive));
      ASSERT_TRUE(state->moveTo(1, goal, drive));
      motion.advance(0.013);
      state->advance(0.013);
      EXPECT_EQ(motion.sample(0, 1).position, state->sample(1).position);
      EXPECT_EQ(motion.sample(0, 1).velocity, state->sample(1).velocity);
    }
    ASSERT_TRUE(motion.push(0, 0.3, 2));
    ASSERT_TRUE(state->push(0, 0.3, 2));
  }
  EXPECT_EQ(motion.sample(0, 0).position, state->sample(0).position);
}

TEST(RegionalMotion, AStepOfAClockOfOtherUnitsIsNone) {
  RegionalMotion motion = motionOf({0.0}, {{}, {1, 1, 0.5}});
  ASSERT_TRUE(motion.moveTo(0, 1, {.kind = Drive::Kind::cut, .spring = {}}));
  motion.advance(1.7e18);
  EXPECT_EQ(motion.sample(1, 0).position, 0);
  motion.advance(0.6);
  EXPECT_EQ(motion.sample(1, 0).position, 1);
}

// m q″ = −k (q − 1) − c q′ with the same damper everywhere.
TEST(RegionalMotion, ASpringPullsHeavyRegionsByNewtonsLaw) {
  const Matter matter{4, 2, 0};
  RegionalMotion motion = motionOf({0.0}, {{}, matter});
  ASSERT_TRUE(motion.moveTo(0, 1, spring(2, 0.7)));
  const double omega = 2 * std::numbers::pi * 2, stiffness = omega * omega,
               damper = 2 * 0.7 * omega;
  for (int k = 0; k < 100; ++k) {
    motion.advance(0.01);
    const Kinematics heavy = motion.sample(1, 0), light = motion.sample(0, 0);
    EXPECT_NEAR(matter.mass * heavy.acceleration,
                -matter.stiffness * stiffness * (heavy.position - 1) - damper * heavy.velocity,
                1e-9);
    EXPECT_NEAR(light.acceleration, -stiffness * (light.position - 1) - damper * light.velocity,
                1e-9);
  }
}

TEST(RegionalMotion, TheSamePullTakesAHeavyRegionLonger) {
  for (const auto kind : {Drive::Kind::newton, Drive::Kind::accelerateBrake,
                          Drive::Kind::linearForce, Drive::Kind::bounce}) {
    Drive drive;
    drive.kind = kind;
    drive.seconds = 0.5;
    RegionalMotion motion = motionOf({0.0}, {{}, {4, 1, 0}});
    ASSERT_TRUE(motion.moveTo(0, 1, drive));
    motion.advance(0.1);
    EXPECT_NEAR(4 * motion.sample(1, 0).acceleration, motion.sample(0, 0).acceleration,
                kind == Drive::Kind::linearForce ? 10 : 1e-9);
    EXPECT_LT(motion.sample(1, 0).position, motion.sample(0, 0).position);
    motion.advance(0.9 - 1e-9);
    EXPECT_NEAR(motion.sample(1, 0).position, 1, 1e-7);  // after twice the time
  }
}

TEST(RegionalMotion, LateRegionsDoTheSameLater) {
  RegionalMotion motion = motionOf({0.0}, {{}, {1, 1, 0.25}});
  ASSERT_TRUE(motion.moveTo(0, 1, spring(3, 0.5)));
  std::vector<double> first;
  for (int k = 0; k < 16; ++k) {
    first.push_back(motion.sample(0, 0).position);
    const double late = motion.sample(1, 0).position;
    EXPECT_NEAR(late, k < 4 ? 0 : first[k - 4], 1e-12) << k;
    motion.advance(0.0625);
  }
}

// A tracker sets goals at intervals shorter than the region's delay.
TEST(RegionalMotion, LateRegionsGoAfterEveryGoal) {
  constexpr int late = 8;
  RegionalMotion motion = motionOf({0.0, 0.0}, {{}, {1, 1, late * 0.015625}});
  std::vector<double> first;
  for (int k = 0; k < 200; ++k) {
    first.push_back(motion.sample(0, 1).position);
    EXPECT_NEAR(motion.sample(1, 1).position, k < late ? 0 : first[k - late], 1e-12) << k;
    ASSERT_TRUE(motion.moveTo(std::vector{0.0, std::sin(0.1 * k)}, spring(3, 0.5)));
    motion.advance(0.015625);
  }
}

TEST(RegionalMotion, LateRegionsMissNoneOf120GoalsASecond) {
  constexpr int late = 64;
  constexpr double frame = 1.0 / 128;  // adds up without rounding
  RegionalMotion motion = motionOf({0.0}, {{}, {1, 1, late * frame}});
  std::vector<double> first;
  for (int k = 0; k < 4 * late; ++k) {
    if (k % 16 > 0) {
      ASSERT_TRUE(motion.moveTo(0, std::sin(k), {.kind = Drive::Kind::cut, .spring = {}}));
    }
    first.push_back(motion.sample(0, 0).position);
    EXPECT_EQ(motion.sample(1, 0).position, k < late ? 0 : first[k - late]) << k;
    motion.advance(frame);
  }
}

TEST(RegionalMotion, MoreGoalsThanCanWaitBecomeFewer) {
  RegionalMotion motion = motionOf({0.0, 0.0}, {{}, {1, 1, 2}});
  constexpr double frame = 1.0 / 512;
  std::vector<double> first;
  for (int k = 0; k < 6 * 512; ++k) {
    first.push_back(motion.sample(0, 0).position);
    if (k >= 4 * 512) {
      EXPECT_NEAR(motion.sample(1, 0).position, first[k - 1024], 0.1) << k;
    }
    ASSERT_TRUE(motion.moveTo(0, k < 5 * 512 ? std::sin(2 * frame * k) : 0.75, spring(3, 1)));
    ASSERT_TRUE(k > 0 || motion.moveTo(1, 1, spring(3, 1)));
    motion.advance(frame);
  }
  motion.advance(4);
  EXPECT_NEAR(motion.sample(1, 0).position, 0.75, 1e-9) << "the last one is kept";
  EXPECT_NEAR(motion.sample(1, 1).position, 1, 1e-9) << "and the only one of a weight";
}

// No weight loses its goal, even if the delay is below the clock's resolution.
TEST(RegionalMotion, GoalsOfOneInstantBecomeTheLast) {
  auto motion = RegionalMotion::make(std::vector<double>{0, 0}, std::vector{Matter{1, 1, 1e-17}});
  ASSERT_TRUE(motion);
  motion->advance(1);
  const Drive drive{.kind = Drive::Kind::cut, .spring = {}};
  EXPECT_TRUE(motion->moveTo(1, 1, drive));
  for (int k = 1; k <= 8; ++k) EXPECT_TRUE(motion->moveTo(0, k / 16.0, drive));
  motion->advance(1);
  EXPECT_EQ(motion->sample(0, 0).position, 0.5);
  EXPECT_EQ(motion->sample(0, 1).position, 1);
}

TEST(RegionalMotion, GoalsThatBecomeOneHaveTheDriveOfTheLast) {
  RegionalMotion motion = motionOf({0.0}, {{1, 1, 1}});
  for (int k = 0; k < 2000; ++k)
    ASSERT_TRUE(motion.moveTo(0, 0.5, {.kind = Drive::Kind::cut, .spring = {}}));
  ASSERT_TRUE(motion.moveTo(0, 1, {.kind = Drive::Kind::newton, .seconds = 1, .spring = {}}));
  motion.advance(1.5);
  EXPECT_NEAR(motion.sample(0, 0).position, std::lerp(0.5, 1, 0.25), 1e-12);
}

// m q″ = −c q′ after an impulse of the same momentum everywhere.
TEST(RegionalMotion, ABlowMovesHeavyRegionsByNewtonsLaw) {
  const std::vector<Matter> matters{{}, {4, 1, 0}};
  const double impulse = 2, drag = 4, seconds = 0.1;
  RegionalMotion motion = motionOf({0.0}, matters);
  ASSERT_TRUE(motion.push(0, impulse, drag));
  motion.advance(seconds);
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_NEAR(matters[r].mass * motion.sample(r, 0).velocity,
                impulse * std::exp(-drag / matters[r].mass * seconds), 1e-12);
}

TEST(RegionalMotion, LateRegionsFeelABlowAtOnce) {
  RegionalMotion motion = motionOf({0.0}, {{}, {1, 1, 0.5}});
  ASSERT_TRUE(motion.moveTo(0, 1, spring(3, 1)));
  ASSERT_TRUE(motion.push(0, 2, 4));
  motion.advance(9);
  EXPECT_NEAR(motion.sample(1, 0).position, 0.5, 1e-9) << "where drag stops it";
}

TEST(RegionalMotion, MovesWhileAnyRegionDoesOrWillSetOut) {
  RegionalMotion motion = motionOf({0}, {{}, {1, 1, 0.5}});
  EXPECT_FALSE(motion.moves());
  Drive brief;
  brief.kind = Drive::Kind::newton, brief.seconds = 0.2;
  ASSERT_TRUE(motion.moveTo(0, 1, brief));
  for (const double seconds : {0.1, 0.2, 0.3, 0.05}) {
    EXPECT_TRUE(motion.moves()) << seconds;
    motion.advance(seconds);
  }
  EXPECT_TRUE(motion.moves());  // the late region moves until 0.7
  motion.advance(0.06);
  EXPECT_FALSE(motion.moves());
}

TEST(RegionalMotion, WhatIsPutSomewhereStaysThere) {
  RegionalMotion motion = motionOf({0.0, 0.0}, {{}, {1, 1, 0.5}});
  ASSERT_TRUE(motion.moveTo(0, 1, spring(3, 1)));
  ASSERT_TRUE(motion.moveTo(1, 1, spring(3, 1)));
  ASSERT_TRUE(motion.put(1, 0, 0.25));
  motion.advance(9);
  EXPECT_EQ(motion.sample(1, 0).position, 0.25);
  EXPECT_NEAR(motion.sample(1, 1).position, 1, 1e-9);
}

TEST(RegionalMotion, GoesAfterItsGoalWhereWhatIsPutIsRefused) {
  RegionalMotion motion = motionOf({0.0}, {{}, {1, 1, 0.5}});
  ASSERT_TRUE(motion.moveTo(0, 1, spring(3, 1)));
  ASSERT_FALSE(motion.put(1, 0, std::numeric_limits<double>::quiet_NaN()));
  motion.advance(9);
  EXPECT_NEAR(motion.sample(1, 0).position, 1, 1e-9);
}

TEST(RegionalMotion, GoesOnWithoutAJumpInAnyRegion) {
  RegionalMotion motion = motionOf({0.0, 0.0}, {{}, {5, 1, 0.05}, {0.3, 2, 0}});
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 2000; ++k) {
    std::array<Kinematics, 3> before;
    for (std::size_t r = 0; r < 3; ++r) before[r] = motion.sample(r, 0);
    ASSERT_TRUE(motion.moveTo(0, uniform(random), spring(2 + uniform(random), 0.6)));
    for (std::size_t r = 0; r < 3; ++r) {
      EXPECT_NEAR(motion.sample(r, 0).position, before[r].position, 1e-12);
      EXPECT_NEAR(motion.sample(r, 0).velocity, before[r].velocity, 1e-11);
    }
    motion.advance(0.1 * std::abs(uniform(random)));
  }
}

TEST(RegionalMotion, DoesNotDependOnTheFrameRate) {
  RegionalMotion coarse = motionOf({0.0}, {{}, {3, 1, 0.03}}), fine = coarse;
  ASSERT_TRUE(coarse.moveTo(0, 1, spring(2, 0.4)));
  ASSERT_TRUE(fine.moveTo(0, 1, spring(2, 0.4)));
  coarse.advance(0.1);
  for (int k = 0; k < 100; ++k) fine.advance(0.001);
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_NEAR(coarse.sample(r, 0).position, fine.sample(r, 0).position, 1e-12);
}

TEST(RegionalMotion, SendsOneRegionAlone) {
  RegionalMotion motion = motionOf({0.0}, {{}, {}});
  Drive cut;
  cut.kind = Drive::Kind::cut;
  ASSERT_TRUE(motion.moveTo(1, 0, 0.5, cut));
  std::vector<double> weights(2);
  motion.positions(weights);
  EXPECT_EQ(weights, (std::vector<double>{0, 0.5}));
  EXPECT_FALSE(motion.moveTo(2, 0, 0.5, cut));
}

TEST(RegionalMotion, RefusesWithoutAChange) {
  EXPECT_FALSE(RegionalMotion::make(std::vector{0.0}, std::vector<Matter>{}));
  EXPECT_FALSE(RegionalMotion::make(std::vector{0.0}, std::vector<Matter>{{0, 1, 0}}));
  EXPECT_FALSE(RegionalMotion::make(std::vector{0.0}, std::vector<Matter>{{1, 1, -1}}));
  EXPECT_FALSE(RegionalMotion::make(std::vector{std::nan("")}, std::vector<Matter>{{}}));
  RegionalMotion motion = motionOf({0.0, 0.0}, {{}, {}});
  EXPECT_FALSE(motion.moveTo(std::vector{1.0, std::nan("")}));
  EXPECT_FALSE(motion.moveTo(2, 1));
  RegionalMotion uneven = motionOf({0.0}, {{1, 1, 0}, {1e-4, 1, 0}});
  EXPECT_FALSE(uneven.push(0, 1e306, 0));  // too much for the light one
  EXPECT_EQ(uneven.sample(0, 0).velocity, 0);
  EXPECT_FALSE(uneven.moveTo(0, 1, spring(9e151, 1)));  // so is this
  uneven.advance(1);
  EXPECT_EQ(uneven.sample(0, 0).position, 0);
  EXPECT_FALSE(motionOf({0.0}, {{1, 1, 0.5}}).moveTo(0, 0, std::nan(""), {}));
  motion.advance(1);
  EXPECT_EQ(motion.sample(1, 0).position, 0);
}

// ---- Clips ----

/// A weight that goes up and down.
Clip wave(double framesPerSecond) {
  Clip clip{{"jawOpen"}, {}, {}};
  for (int k = 0; k <= 2 * framesPerSecond; ++k) {
    const double t = k / framesPerSecond;
    clip.times.push_back(t);
    clip.weights.push_back(0.5 - 0.5 * std::cos(2 * std::numbers::pi * t));
  }
  return clip;
}

TEST(RegionalClip, MatterOfOneIsTheClipItself) {
  const Clip clip = wave(60);
  EXPECT_EQ(inMatter(clip, {}).weights, clip.weights);
  EXPECT_EQ(inMatter(clip, {1, 7, 0}).weights, clip.weights);
}

TEST(RegionalClip, AHeavyRegionFollowsLate) {
  const Clip clip = wave(60), heavy = inMatter(clip, {8, 1, 0}, {3, 0.7});
  const auto peak = [](const Clip& c) {
    std::vector<double> weight(1);
    double most = 0, at = 0;
    for (double t = 0; t < 1; t += 1e-3)
      if (c.at(t, weight); weight[0] > most) most = weight[0], at = t;
    return at;
  };
  EXPECT_GT(peak(heavy), peak(clip) + 0.04);
  EXPECT_EQ(inMatter(clip, {8, 1, 0}, {3, 0.7}, 0).weights, heavy.weights);  // 0 regions count as 1
  // A tiny excess of mass changes little.
  const Clip hardly = inMatter(clip, {1 + 1e-4, 1, 0}, {3, 0.7});
  std::vector<double> recorded(1);
  for (std::size_t k = 0; k < hardly.weights.size(); ++k) {
    clip.at(hardly.times[k], recorded);
    EXPECT_NEAR(hardly.weights[k], recorded[0], 1e-3);
  }
}

// Compared with semi-implicit Euler, with steps so small that the order of the method does not
// matter.
TEST(RegionalClip, ObeysNewtonsLaw) {
  const Clip clip = wave(30);
  const Matter matter{3, 2, 0};
  const Spring hold{2, 0.6};
  const Clip heavy = inMatter(clip, matter, hold);
  const double omega = 2 * std::numbers::pi * hold.frequency, excess = matter.mass - 1;
  const double stiffness = matter.stiffness * omega * omega, damper = 2 * hold.damping * omega;
  double x = clip.weights[0], v = 0;
  constexpr int steps = 20000;
  for (std::size_t f = 1; f < clip.times.size(); ++f) {
    const double span = clip.times[f] - clip.times[f - 1], h = span / steps;
    const double speed = (clip.weights[f] - clip.weights[f - 1]) / span;
    for (int k = 0; k < steps; ++k) {
      const double g = clip.weights[f - 1] + speed * h * (k + 0.5);
      v += h * (stiffness * (g - x) + damper * (speed - v)) / excess;
      x += h * v;
    }
    std::vector<double> found(1);
    heavy.at(clip.times[f], found);
    EXPECT_NEAR(found[0], x, 1e-4) << f;
  }
}

// Clips with few keys, like animations in files.
TEST(RegionalClip, FewFramesDoAsWellAsMany) {
  const Clip few{{"jawOpen"}, {0, 1, 2}, {0, 1, 0}};
  Clip many{{"jawOpen"}, {}, {}};
  for (int k = 0; k <= 480; ++k) {
    many.times.push_back(k / 240.0);
    many.weights.push_back(1 - std::abs(k / 240.0 - 1));
  }
  for (const Matter& matter : {Matter{1, 1, 0.5}, Matter{4, 1, 0}, Matter{3, 1, 0.25}}) {
    const Clip a = inMatter(few, matter), b = inMatter(many, matter);
    std::vector<double> x(1), y(1);
    for (double t = 0; t < 3; t += 0.01) {
      a.at(t, x), b.at(t, y);
      EXPECT_NEAR(x[0], y[0], 2e-3) << matter.mass << " " << t;
    }
  }
}

// Cuts each interval between frames into `pieces`. The last frame is left out.
Clip cutFinely(const Clip& clip, int pieces) {
  Clip fine{clip.names, {}, {}};
  for (std::size_t f = 1; f < clip.times.size(); ++f)
    for (int k = 0; k < pieces; ++k) {
      const double s = k / static_cast<double>(pieces);
      fine.times.push_back(std::lerp(clip.times[f - 1], clip.times[f], s));
      fine.weights.push_back(std::lerp(clip.weights[f - 1], clip.weights[f], s));
    }
  return fine;
}

double furthestApart(const Clip& a, const Clip& b, double seconds) {
  std::vector<double> x(1), y(1);
  double most = 0;
  for (double t = 0; t < seconds; t += 2e-4) {
    a.at(t, x), b.at(t, y);
    most = testing::greater(most, std::abs(x[0] - y[0]));
  }
  return most;
}

// A recorded blink in regions from barely to much heavier, compared with frames 200 times as dense.
TEST(RegionalClip, StraightLinesAreAsGoodAsExact) {
  const Clip blink{{"eyeBlinkLeft"},
                   {0, 1 / 60., 2 / 60., 3 / 60., 4 / 60., 5 / 60., 6 / 60., 7 / 60., 0.5},
                   {0, 0.2, 0.8, 1, 1, 0.7, 0.3, 0, 0}};
  for (const double mass : {1.001, 1.05, 1.1, 1.5, 2.0, 4.0}) {
    const Clip heavy = inMatter(blink, {mass, 1, 0});
    EXPECT_LT(furthestApart(heavy, inMatter(cutFinely(blink, 200), {mass, 1, 0}), 0.49), 1e-4)
        << mass;
    EXPECT_LT(heavy.times.size(), 600u) << mass;
  }
}

TEST(RegionalClip, StraightLinesAreAsGoodWhereAStiffRegionSwings) {
  const Clip rise{{"jawOpen"}, {0, 0.1, 1}, {0, 1, 1}};
  for (const double stiffness : {20.0, 100.0, 300.0, 1000.0}) {
    const Matter matter{2, stiffness, 0};
    EXPECT_LT(furthestApart(inMatter(rise, matter), inMatter(cutFinely(rise, 4000), matter), 0.99),
              3e-4)
        << stiffness;
  }
}

// Impulses in resonance with the swing add up.
TEST(RegionalClip, StraightLinesAreAsGoodWhereBlowsAddUp) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1);
  for (const auto& [rate, matter, hold] : {std::tuple{30.0, Matter{2, 9, 0}, Spring{20, 0.1}},
                                           {30.0, {1.2, 1, 0}, {20, 0.1}},
                                           {10.0, {2, 9, 0}, {20, 0.1}},
                                           {10.0, {1.01, 1, 0}, {2, 0}},
                                           {30.0, {4, 1, 0}, {6, 0.1}}}) {
    Clip clip{{"jawOpen"}, {}, {}};
    for (int f = 0; f < 60; ++f) {
      clip.times.push_back(f / rate);
      clip.weights.push_back(hold.frequency == 6 ? f / 4 % 2 : any(random));
    }
    const double end = clip.times.back();
    EXPECT_LT(furthestApart(inMatter(clip, matter, hold),
                            inMatter(cutFinely(clip, 1000), matter, hold), end - 1 / rate),
              1e-4)
        << rate << ' ' << matter.mass;
  }
}

// Pieces get longer as an impulse decays; the last one before a recorded frame is at most a quarter
// longer than planned.
TEST(RegionalClip, StraightLinesAreAsGoodRightBeforeARecordedFrame) {
  Clip jump{{"jawOpen"}, {}, {}};
  for (int f = 0; f < 12; ++f) {
    jump.times.push_back(f / 60.0);
    jump.weights.push_back(f < 4 ? 0 : 1);
  }
  const Matter matter{4, 2, 0};
  const Spring hold{8, 1};
  EXPECT_LT(furthestApart(inMatter(jump, matter, hold),
                          inMatter(cutFinely(jump, 400), matter, hold), 0.18),
            1e-4);
}

TEST(RegionalClip, FramesThatAreHardlyApartAreAJump) {
  const Matter matter{4, 1, 0};
  const auto after = [&](double apart) {
    const Clip step{{"jawOpen"}, {0, 0.1, 0.1 + apart, 1}, {0, 0, 1, 1}};
    std::vector<double> weight(1);
    inMatter(step, matter).at(0.3, weight);
    return weight[0];
  };
  EXPECT_NEAR(after(1e-12), after(1e-5), 1e-3);
  const Clip instant{{"jawOpen"}, {0, 1e-308, 2e-308}, {0, 1, 0.5}};
  for (const double weight : inMatter(instant, matter).weights) EXPECT_LE(std::abs(weight), 1);
}

// At the largest times that recordings may have, where doubles are about a microsecond apart.
TEST(RegionalClip, WhatSettlesAtOnceIsThere) {
  const Clip clip{{"jawOpen"}, {1e10, 1e10 + 0.5, 1e10 + 1}, {0, 1, 0}};
  for (const double excess : {1e-15, 1e-12, 1e-9, 1e-6}) {
    const Clip heavy = inMatter(clip, {1 + excess, 1, 0});
    std::vector<double> recorded(1);
    for (std::size_t k = 0; k < heavy.times.size(); ++k) {
      if (k > 0) {
        ASSERT_GT(heavy.times[k], heavy.times[k - 1]);
      }
      clip.at(heavy.times[k] - clip.times.front(), recorded);
      ASSERT_NEAR(heavy.weights[k], recorded[0], 1e-3) << excess;
    }
  }
}

TEST(RegionalClip, AHeavyRegionArrives) {
  const Clip clip{{"jawOpen"}, {0, 1.9, 2}, {0, 0, 1}};
  const Clip heavy = inMatter(clip, {4, 1, 0}, {2, 0.3});
  EXPECT_GT(heavy.seconds(), 2.2);
  EXPECT_NEAR(heavy.weights.back(), 1, 1e-2);
  // A swing that never stops is shown for a limited time.
  EXPECT_NEAR(inMatter(clip, {4, 1, 0}, {2, 1e-9}).seconds(), 12, 0.1);
}

// A take with a pause of nine hours holds hardly more frames than one without.
TEST(RegionalClip, AHeavyRegionThatHangsStillNeedsNoFrames) {
  const Clip clip{{"jawOpen"}, {0, 0.1, 32400, 32400.1, 1e9}, {0, 1, 1, 0, 0.5}};
  const Clip heavy = inMatter(clip, {4, 1, 0}, {2, 0.7});
  EXPECT_LT(heavy.times.size(), 4 * 1200u);
  std::vector<double> found(1);
  heavy.at(100, found);
  EXPECT_NEAR(found[0], 1, 1e-3);
  heavy.at(32400.12, found);
  EXPECT_GT(found[0], 0.5);  // it lags
  heavy.at(32500, found);
  EXPECT_NEAR(found[0], 0, 1e-3);
}

TEST(RegionalClip, SharesTheRoomWithOtherRegions) {
  const Clip clip{{"jawOpen"}, {0, 2}, {0, 1}};
  const std::size_t regions = kMostClipWeights / 100;
  EXPECT_GT(inMatter(clip, {4, 1, 0}).weights.size(), 200u);
  EXPECT_LE(inMatter(clip, {4, 1, 0}, {}, regions).weights.size(), 100u);
}

TEST(RegionalClip, HoldsNoMoreThanItsShareHoweverMuchSwings) {
  Clip clip{{}, {}, {}};
  clip.names.resize(4);
  for (int f = 0; f < 6000; ++f) {
    clip.times.push_back(f / 30.0);
    for (int k = 0; k < 4; ++k) clip.weights.push_back(f / (4 + k) % 2);
  }
  constexpr std::size_t kRegions = 800;  // leaves room for three frames per recorded one
  const Clip heavy = inMatter(clip, {4, 1, 0}, {6, 0}, kRegions);
  EXPECT_LE(heavy.weights.size(), kMostClipWeights / kRegions);
  EXPECT_GT(heavy.weights.size(), kMostClipWeights / kRegions / 2);
}

TEST(RegionalClip, ALateRegionShowsTheClipLater) {
  const Clip clip = wave(40), late = inMatter(clip, {1, 1, 0.25});
  std::vector<double> found(1);
  for (std::size_t f = 0; f < clip.times.size(); ++f) {
    late.at(clip.times[f], found);
    EXPECT_NEAR(found[0], clip.weights[f < 10 ? 0 : f - 10], 1e-12);
  }
  // It goes on until the whole clip has been shown.
  EXPECT_NEAR(late.seconds(), clip.seconds() + 0.25, 1e-12);
  EXPECT_NEAR(late.weights.back(), clip.weights.back(), 1e-12);
  // A heavy region ends later by the same delay.
  EXPECT_NEAR(inMatter(clip, {4, 1, 0.25}).seconds(), inMatter(clip, {4, 1, 0}).seconds() + 0.25,
              1e-12);
}

TEST(RegionalClip, OfManyNamesIsNotStretchedBeyondWhatAClipHolds) {
  Clip wide{std::vector<std::string>(100'000, "a"), {0, 0.001}, {}};
  wide.weights.assign(200'000, 0.5);
  const Clip late = inMatter(wide, {1, 1, 60});
  EXPECT_LE(late.weights.size(), kMostClipWeights);
  EXPECT_NEAR(late.seconds(), 60.001, 1e-9);
}

TEST(RegionalTimeline, EventsAreForOneRegionOrForAll) {
  const auto timeline = parseTimeline(R"({"seconds": 2, "events": [
    {"at": 0, "to": {"smile": 1}, "drive": "cut", "region": "left"},
    {"at": 1, "to": {"smile": 0.5}, "drive": "newton", "seconds": 0.25}]})",
                                      "t");
  ASSERT_TRUE(timeline) << timeline.error().message;
  const auto weight = [&](std::string_view region, const Matter& matter, double time) {
    std::vector<double> out(1);
    bake(*timeline, 100, region, matter)->at(time, out);
    return out[0];
  };
  EXPECT_EQ(weight("left", {}, 0.5), 1);
  EXPECT_EQ(weight("rest", {}, 0.5), 0);
  EXPECT_EQ(weight("rest", {}, 1.25), 0.5);
  EXPECT_NEAR(weight("rest", {4, 1, 0}, 1.25), 0.125, 1e-12);  // after half of its time
  EXPECT_EQ(weight("rest", {1, 1, 0.3}, 1.29), 0);
}

TEST(RegionalTimeline, LateRegionsPlayAllOfIt) {
  const auto timeline = parseTimeline(R"({"seconds": 0.6, "loops": 3, "events": [
    {"at": 0, "to": {"smile": 1}, "drive": "newton", "seconds": 0.2},
    {"at": 0.3, "to": {"smile": 0}, "drive": "newton", "seconds": 0.2},
    {"at": 0.6, "to": {"jawOpen": 1}, "drive": "cut"}]})",
                                      "t");
  ASSERT_TRUE(timeline) << timeline.error().message;
  const auto now = bake(*timeline, 100, "", {}), late = bake(*timeline, 100, "", {1, 1, 0.4});
  EXPECT_NEAR(late->seconds(), now->seconds() + 0.4, 1e-12);
  std::vector<double> a(2), b(2);
  for (double t = 0; t < 1.79; t += 0.01) {
    now->at(t, a), late->at(t + 0.4, b);
    EXPECT_NEAR(a[0], b[0], 1e-9) << t;
  }
  EXPECT_EQ(now->weights.back(), 1) << "what is at the very end is still seen";
  EXPECT_EQ(late->weights.back(), 1);
}

}  // namespace
}  // namespace sweepface
