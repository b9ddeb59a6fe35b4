#include "sweepface/filter.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace sweepface {
namespace {

/// A weight that rests, moves in half a second and rests again, at 60 frames a second.
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
  // In the middle of the move it lags by less than a tenth of a second.
  EXPECT_GT(clip.weights[107], wanted.weights[101]);
  EXPECT_NEAR(clip.weights.back(), 1, 0.01);
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

}  // namespace
}  // namespace sweepface
