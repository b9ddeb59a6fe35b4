#include "fit/pose_cost.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace sweepface {
namespace {

constexpr Index kVertices = 40, kVectors = 12;

// Vectors that each move some vertices, and a pose whose errors exceed the bounds in places.
class RandomErrors : public ::testing::TestWithParam<unsigned> {
 protected:
  RandomErrors() {
    columns.start = {0};
    for (Index v = 0; v < kVectors; ++v) {
      for (Index u = 0; u < kVertices; ++u)
        if (random(0, 1) < 0.4f) {
          columns.vertex.push_back(u);
          columns.weight.push_back({random(-1, 1), random(-1, 1), random(-1, 1)});
        }
      columns.start.push_back(static_cast<Index>(columns.vertex.size()));
    }
    task.step = 0.05;
    task.bounds.assign(kVertices, 0.5f);
    task.slopes.weight = 3;
    for (Index u = 0; u < kVertices; ++u) {
      task.errors.push_back({random(-0.4f, 0.4f), random(-0.4f, 0.4f), random(-0.4f, 0.4f)});
      task.slopes.at.push_back({tangent(), tangent()});
    }
  }

  float random(float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(generator);
  }
  Slopes::Tangent tangent() {
    const std::array<float, 3> n{0.6f, 0, 0.8f}, e{random(-0.5f, 0.5f), random(-0.5f, 0.5f), 0};
    return {e, e[0] * n[0] + e[2] * n[2], n, random(0.5f, 2)};
  }
  // Moves a coefficient of a task by a number of steps.
  void move(Index v, int a, float steps) {
    for (Index p = columns.start[v]; p < columns.start[v + 1]; ++p) {
      const Index u = columns.vertex[p];
      const float x = steps * static_cast<float>(task.step);
      double* const error = a == 0   ? &task.errors[u].x
                            : a == 1 ? &task.errors[u].y
                                     : &task.errors[u].z;
      *error += x * columns.weight[p][0];
      for (int side = 0; side < 2; ++side) {
        Slopes::Tangent& t = task.slopes.at[u][side];
        const float change = x * columns.weight[p][1 + side] * t.perLength;
        t.error[a] += change;
        t.lean += change * t.normal[a];
      }
    }
  }

  std::mt19937 generator{GetParam()};
  Columns columns;
  PoseTask task;
};

TEST_P(RandomErrors, GrowAsTheirGradientSays) {
  const PoseCost errors(columns, task);
  constexpr float kSmall = 1e-2f;
  for (Index v = 0; v < kVectors; ++v) {
    const PoseCost::Four gradient = errors.gradient(v);
    for (int a = 0; a < 3; ++a) {
      // The one-sided differences disagree where a vertex reaches its bound in between.
      const float ahead = errors.growth(v, a, kSmall) / kSmall,
                  behind = -errors.growth(v, a, -kSmall) / kSmall;
      const float off = 0.03f * (1 + std::abs(ahead));
      EXPECT_GE(gradient[a], std::min(ahead, behind) - off);
      EXPECT_LE(gradient[a], std::max(ahead, behind) + off);
    }
  }
}

TEST_P(RandomErrors, GrowTheSameOneByOneAndFourAtOnce) {
  const PoseCost errors(columns, task);
  const PoseCost::Four four = errors.growth(3, 1, PoseCost::Four{-1, 0, 1, 2});
  EXPECT_EQ(four[0], errors.growth(3, 1, -1));
  EXPECT_EQ(four[1], 0);
  EXPECT_EQ(four[2], errors.growth(3, 1, 1));
  EXPECT_EQ(four[3], errors.growth(3, 1, 2));
}

TEST_P(RandomErrors, AreAfterMovesWhatTheyWouldBeFromTheStart) {
  PoseCost errors(columns, task);
  for (int k = 0; k < 20; ++k) {
    const auto v = static_cast<Index>(generator() % kVectors);
    const int a = static_cast<int>(generator() % 3);
    const auto steps = static_cast<float>(generator() % 3) - 1;
    const float there = errors.growth(v, a, steps);
    errors.move(v, a, steps);
    move(v, a, steps);
    EXPECT_NEAR(errors.growth(v, a, -steps), -there, 1e-3f * (1 + std::abs(there)));
  }
  const PoseCost fresh(columns, task);
  for (Index u = 0; u < kVertices; ++u) {
    EXPECT_NEAR(errors.square(u), fresh.square(u), 1e-4f);
    EXPECT_NEAR(errors.tilt(u), fresh.tilt(u), 1e-2f);
  }
  for (Index v = 0; v < kVectors; ++v) {
    const PoseCost::Four own = errors.gradient(v), its = fresh.gradient(v);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(own[a], its[a], 1e-2f * (1 + std::abs(its[a])));
  }
}

TEST_P(RandomErrors, CountMoreBeyondTheirBoundsOncePressed) {
  PoseCost errors(columns, task);
  constexpr float kFar = 20;
  const float before = errors.growth(0, 1, kFar);
  errors.press(100);
  EXPECT_GT(errors.growth(0, 1, kFar), 2 * before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomErrors, ::testing::Range(1u, 6u));

}  // namespace
}  // namespace sweepface
