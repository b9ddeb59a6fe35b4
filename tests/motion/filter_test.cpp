#include "sweepface/filter.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace sweepface {
namespace {

/// A weight that rests, moves for half a second and rests again, at 60 frames a second.
Clip take(double noise) {
  std::mt19937 engine(5);
  std::normal_distribution wobble(0.0, noise);
  Clip clip{{"jawOpen"}, {}, {}};
  for (int f = 0; f < 240; ++f) {
    clip.times.push_back(f / 60.0);
    const double s = std::min(1.0, std::max(0.0, (f / 60.0 - 1.5) / 0.5));
    clip.weights.push_back(s * s * (3 - 2 * s) + (noise > 0 ? wobble(engine) : 0));
  }
  return clip;
}

double spread(const Clip& clip, int first, int last, double around) {
  double sum = 0;
  for (int f = first; f < last; ++f) sum += std::pow(clip.weights[f] - around, 2);
  return std::sqrt(sum / (last - first));
}

TEST(OneEuro, TakesNoiseOutOfWhatRests) {
  Clip clip = take(0.01);
  const double before = spread(clip, 30, 90, 0);
  smooth(clip);
  EXPECT_LT(spread(clip, 30, 90, 0), before / 2);
}

TEST(OneEuro, FollowsWhatMoves) {
  const Clip wanted = take(0);
  Clip clip = wanted;
  smooth(clip);
  // In the middle of the move it is neither late nor early.
  EXPECT_NEAR(clip.weights[105], wanted.weights[105], 1e-3);
  EXPECT_NEAR(clip.weights.back(), 1, 0.01);
}

/// Syllables, and lips that close briefly.
TEST(OneEuro, KeepsSpeech) {
  Clip clip{{"jawOpen", "mouthClose"}, {}, {}};
  for (int f = 0; f < 240; ++f) {
    const double t = f / 60.0;
    clip.times.push_back(t);
    clip.weights.push_back(0.3 + 0.125 * std::sin(2 * std::numbers::pi * 5 * t));
    clip.weights.push_back(0.2 * std::exp(-0.5 * std::pow((t - 2) / 0.035, 2)));
  }
  smooth(clip);
  std::array<double, 2> high{-1, -1}, low{1, 1};
  for (std::size_t f = 60; f < 180; ++f)
    for (std::size_t k = 0; k < 2; ++k) {
      high[k] = std::max(high[k], clip.weights[2 * f + k]);
      low[k] = std::min(low[k], clip.weights[2 * f + k]);
    }
  EXPECT_GT(high[0] - low[0], 0.9 * 0.25);
  EXPECT_GT(high[1], 0.9 * 0.2);
  EXPECT_EQ(high[1], clip.weights[2 * 120 + 1]) << "and at the same time";
}

TEST(OneEuro, TheFirstFrameAndOneAfterNoTimePass) {
  OneEuroFilter filter(1);
  std::array<double, 1> weight{0.7};
  filter.apply(0.1, weight);
  EXPECT_EQ(weight[0], 0.7);
  weight[0] = 0.1;
  filter.apply(0, weight);
  EXPECT_EQ(weight[0], 0.1);
  weight[0] = 0.9;
  filter.apply(1e-310, weight);
  EXPECT_EQ(weight[0], 0.9);
}

TEST(OneEuro, AFrameAfterNoTimeBeginsAnew) {
  constexpr double kFrame = 1.0 / 60;
  OneEuroFilter quick(1), fresh(1);
  std::array<double, 1> weight{}, wanted{};
  for (int f = 0; f < 30; ++f) {
    weight[0] = 0.1 * f;
    quick.apply(kFrame, weight);
  }
  for (const auto& [seconds, value] : {std::pair{0.0, 0.0}, {kFrame, 0.05}}) {
    weight[0] = wanted[0] = value;
    quick.apply(seconds, weight);
    fresh.apply(seconds, wanted);
  }
  EXPECT_EQ(weight, wanted);
}

}  // namespace
}  // namespace sweepface
