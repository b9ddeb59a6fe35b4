#include "sweepface/keys.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "sweepface/trajectory.hpp"

#include "greater.hpp"

namespace sweepface {
namespace {

/// A clip sampled from trajectories.
Clip sampled(const std::vector<Trajectory>& paths, double seconds, double framesPerSecond) {
  Clip clip;
  for (std::size_t k = 0; k < paths.size(); ++k) clip.names.push_back(std::to_string(k));
  for (int f = 0; f <= seconds * framesPerSecond; ++f) {
    clip.times.push_back(f / framesPerSecond);
    for (const Trajectory& path : paths)
      clip.weights.push_back(path.at(f / framesPerSecond).position);
  }
  return clip;
}

/// Slack on a tolerance, as errors are measured exactly where the keys were fitted.
constexpr double kRounding = 1 + 1e-9;

double largestError(const Clip& clip, const CubicKeys& keys) {
  std::vector<double> wanted(clip.names.size()), found(wanted);
  double largest = 0;
  for (std::size_t f = 0; f + 1 < clip.times.size(); ++f)
    for (int part = 0; part < 4; ++part) {
      const double time = std::lerp(clip.times[f], clip.times[f + 1], part / 4.0);
      clip.at(time - clip.times.front(), wanted);
      keys.at(time, found);
      for (std::size_t k = 0; k < wanted.size(); ++k)
        largest = testing::greater(largest, std::abs(wanted[k] - found[k]));
    }
  return largest;
}

TEST(FewestKeys, ACubicNeedsTwo) {
  const Clip clip = sampled({*Trajectory::linearForce({0.2, -1}, 0.7, 2),
                             *Trajectory::constantForce({}, 1, 2), Trajectory(0.3)},
                            2, 1000);
  const CubicKeys keys = fewestKeys(clip, 1e-5);
  EXPECT_EQ(keys.times, (std::vector<double>{0, 2}));
  EXPECT_LE(largestError(clip, keys), 1e-5);
}

TEST(FewestKeys, TwoForcesNeedThree) {
  const Clip clip = sampled({*Trajectory::twoForces({}, 1, 1, 0.5)}, 1, 200);
  const CubicKeys keys = fewestKeys(clip, 1e-4);
  EXPECT_EQ(keys.times.size(), 3u);
  EXPECT_LE(largestError(clip, keys), kRounding * 1e-4);
}

TEST(FewestKeys, SpringsNeedFarFewerThanFrames) {
  const Clip clip =
      sampled({*Trajectory::spring({}, 1, {2, 0.3}), *Trajectory::spring({0.5, 1}, 0.2, {3, 0.7}),
               *Trajectory::spring({}, 0.8, {1, 1})},
              3, 240);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const CubicKeys keys = fewestKeys(clip, tolerance);
    EXPECT_LE(largestError(clip, keys), kRounding * tolerance);
    EXPECT_LT(keys.times.size(), clip.times.size() / 12) << tolerance;
  }
}

TEST(FewestKeys, BouncesKeepTheirCorners) {
  const Clip clip = sampled({*Trajectory::bounce({}, 1, 0.4, 0.6)}, 2, 240);
  const CubicKeys keys = fewestKeys(clip, 1e-3);
  EXPECT_LE(largestError(clip, keys), kRounding * 1e-3);
  EXPECT_LT(keys.times.size(), clip.times.size() / 8);
}

TEST(FewestKeys, NoiseKeepsTheToleranceToo) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  Clip clip{{"a", "b"}, {}, {}};
  double time = 3;
  for (int f = 0; f < 500; ++f) {
    clip.times.push_back(time += 0.001 + 0.03 * uniform(random));
    clip.weights.push_back(uniform(random));
    clip.weights.push_back(f < 250 ? 0 : 1);  // a cut
  }
  const CubicKeys keys = fewestKeys(clip, 0.01);
  EXPECT_LE(largestError(clip, keys), kRounding * 0.01);
  EXPECT_EQ(keys.times.front(), clip.times.front());
  EXPECT_EQ(keys.times.back(), clip.times.back());
}

TEST(FewestKeys, WhatKeepsStillHasNoSlopes) {
  const CubicKeys keys =
      fewestKeys(sampled({*Trajectory::bounce({}, 1, 0.4, 0.6), Trajectory(0.3)}, 2, 240), 1e-3);
  for (std::size_t k = 1; k < keys.in.size(); k += 2) {
    EXPECT_EQ(keys.in[k], 0);
    EXPECT_EQ(keys.out[k], 0);
    EXPECT_EQ(keys.values[k], 0.3);
  }
}

TEST(FewestKeys, OfLittleIsLittle) {
  EXPECT_TRUE(fewestKeys(Clip{{"a"}, {}, {}}, 0.1).times.empty());
  const CubicKeys one = fewestKeys(Clip{{"a"}, {2}, {0.5}}, 0.1);
  EXPECT_EQ(one.values, (std::vector<double>{0.5}));
  std::vector<double> weights(1);
  one.at(7, weights);
  EXPECT_EQ(weights[0], 0.5);
  const CubicKeys two = fewestKeys(Clip{{"a"}, {0, 1}, {0, 0.5}}, 0.1);
  two.at(0.5, weights);
  EXPECT_EQ(weights[0], 0.25);
}

}  // namespace
}  // namespace sweepface
