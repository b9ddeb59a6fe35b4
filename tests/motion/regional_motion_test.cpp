#include "sweepface/regional_motion.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "sweepface/timeline.hpp"

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
    return std::ranges::max_element(c.weights.begin(), c.weights.begin() + 60) - c.weights.begin();
  };
  EXPECT_GT(peak(heavy), peak(clip) + 2);
  // A little more than nothing is little more than nothing.
  const Clip hardly = inMatter(clip, {1 + 1e-4, 1, 0}, {3, 0.7});
  for (std::size_t k = 0; k < clip.weights.size(); ++k)
    EXPECT_NEAR(hardly.weights[k], clip.weights[k], 1e-4);
}

// Against steps so small that the order of the method does not matter (semi-implicit Euler).
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
    EXPECT_NEAR(heavy.weights[f], x, 1e-4) << f;
  }
}

TEST(RegionalClip, ALateRegionShowsTheClipLater) {
  const Clip clip = wave(40), late = inMatter(clip, {1, 1, 0.25});
  for (std::size_t f = 0; f < clip.times.size(); ++f)
    EXPECT_NEAR(late.weights[f], clip.weights[f < 10 ? 0 : f - 10], 1e-12);
  // And goes on until all of it was shown.
  EXPECT_NEAR(late.seconds(), clip.seconds() + 0.25, 1e-12);
  EXPECT_NEAR(late.weights.back(), clip.weights.back(), 1e-12);
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
  EXPECT_NEAR(weight("rest", {4, 1, 0}, 1.25), 0.125, 1e-12);  // half-way in time
  EXPECT_EQ(weight("rest", {1, 1, 0.3}, 1.29), 0);
}

}  // namespace
}  // namespace sweepface
