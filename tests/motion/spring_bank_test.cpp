#include "sweepface/spring_bank.hpp"

#include <array>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace sweepface {
namespace {

/// A single spring and its starting time: the reference for a bank.
struct Alone {
  path::Swing swing{};
  double began = 0;
  bool pulls = false;
};

path::Swing swing(double goal, Start start, Spring spring) {
  return *Trajectory::spring(start, goal, spring)->swing();
}

void expectAlike(const SpringBank& bank, const std::vector<Alone>& alone, double time,
                 double error) {
  std::vector<double> positions(alone.size(), -7), velocities(alone.size(), -7);
  bank.positions(time, positions);
  bank.velocities(time, velocities);
  for (std::size_t k = 0; k < alone.size(); ++k) {
    ASSERT_EQ(bank.pulls(k), alone[k].pulls);
    if (!alone[k].pulls) {
      EXPECT_EQ(positions[k], -7);
      continue;
    }
    const Kinematics exact = alone[k].swing.at(time - alone[k].began), one = bank.at(k, time);
    EXPECT_NEAR(positions[k], exact.position, error);
    EXPECT_NEAR(velocities[k], exact.velocity, 20 * error);
    EXPECT_EQ(positions[k], one.position);
    EXPECT_EQ(velocities[k], one.velocity);
    EXPECT_NEAR(one.acceleration, exact.acceleration, 400 * error);
  }
}

// Whenever a spring sets out, the others of its kind are restarted, over ten thousand rounds.
TEST(SpringBank, SpringsThatSetOutOneByOneGoTheirOwnWays) {
  constexpr std::size_t kWeights = 12;
  const std::array kinds{Spring{2, 1}, Spring{3, 0.3}, Spring{1, 4}, Spring{2.5, 0}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SpringBank bank(kWeights);
  std::vector<Alone> alone(kWeights);
  double time = 0;
  for (int i = 0; i < 10'000; ++i) {
    time += 0.01 * (1 + uniform(random));
    const std::size_t k = random() % kWeights;
    if (random() % 8 == 0) {
      bank.release(k);
      alone[k].pulls = false;
    } else {
      const Spring spring = kinds[random() % kinds.size()];
      alone[k] = {swing(uniform(random), {uniform(random), 5 * uniform(random)}, spring), time,
                  true};
      ASSERT_TRUE(bank.pull(k, alone[k].swing, time));
    }
    if (i % 50 == 0) expectAlike(bank, alone, time + 0.02, 1e-12);
  }
}

TEST(SpringBank, OneThatSetOutBeforeTheOthersCatchesUp) {
  SpringBank bank(2);
  const path::Swing first = swing(1, {0, 0}, {2, 0.5}), second = swing(-1, {0, 3}, {2, 0.5});
  ASSERT_TRUE(bank.pull(0, first, 0.4));
  ASSERT_TRUE(bank.pull(1, second, 0.1));
  expectAlike(bank, {{first, 0.4, true}, {second, 0.1, true}}, 0.9, 1e-14);
}

TEST(SpringBank, TakesOnlySoManyKindsButAnyNumberOneAfterTheOther) {
  constexpr std::size_t kMany = 40;
  SpringBank bank(kMany);
  const auto kind = [](std::size_t k) { return Spring{1 + 0.1 * static_cast<double>(k), 1}; };
  std::size_t taken = 0;
  for (std::size_t k = 0; k < kMany; ++k) taken += bank.pull(k, swing(1, {}, kind(k)), 0);
  EXPECT_GE(taken, 8U);
  EXPECT_LT(taken, kMany);
  EXPECT_FALSE(bank.pulls(kMany - 1));
  for (std::size_t k = 0; k < kMany; ++k) bank.release(k);
  for (std::size_t k = 0; k < kMany; ++k) {
    EXPECT_TRUE(bank.pull(0, swing(1, {}, kind(k)), 0));
    EXPECT_NEAR(bank.at(0, 100).position, 1, 1e-12);
  }
}

TEST(SpringBank, OtherWeightsAreNotTouched) {
  SpringBank bank(3);
  ASSERT_TRUE(bank.pull(1, swing(1, {}, {2, 1}), 0));
  EXPECT_FALSE(bank.pullsAll());
  std::array<double, 2> out{5, 5};  // fewer than the bank has weights
  bank.positions(100, out);
  EXPECT_EQ(out[0], 5);
  EXPECT_NEAR(out[1], 1, 1e-12);
}

}  // namespace
}  // namespace sweepface
