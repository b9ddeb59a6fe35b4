#include "sweepface/motion.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

namespace sweepface {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kSeconds = 0.7, kMass = 2.5;

const std::vector<double> kFrom{0, 0.25, 1, -0.3, 0.1};
const std::vector<double> kTo{1, 0.75, 0, 0.9, 0.1};

Motion motionBy(TimeLaw law) {
  Result<Motion> motion = Motion::make(kFrom, kTo, law, kSeconds, kMass);
  EXPECT_TRUE(motion.has_value());
  return *std::move(motion);
}

struct State {
  double position, velocity;
};

// Integrates q'' = a(t) over one step by three-point Gauss quadrature, of sixth order. Its nodes
// lie inside the step, so jumps of the force between steps do no harm.
template <typename Acceleration>
State gaussStep(State q, double t, double h, Acceleration acceleration) {
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double reach = std::sqrt(15.0) / 10;
  const std::array<double, 3> nodes{0.5 - reach, 0.5, 0.5 + reach};
  State next{q.position + h * q.velocity, q.velocity};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double a = acceleration(t + h * nodes[i]);
    next.position += h * h * weights[i] * (1 - nodes[i]) * a;
    next.velocity += h * weights[i] * a;
  }
  return next;
}

class EveryLaw : public ::testing::TestWithParam<TimeLaw> {};

std::string suiteName(const ::testing::TestParamInfo<TimeLaw>& law) {
  std::string name(nameOf(law.param));
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Motion, EveryLaw, ::testing::ValuesIn(timeLaws), suiteName);

TEST_P(EveryLaw, IsFoundByItsName) {
  const Result<TimeLaw> law = timeLawFromName(nameOf(GetParam()));
  ASSERT_TRUE(law.has_value());
  EXPECT_EQ(*law, GetParam());
}

TEST_P(EveryLaw, StartsAtZeroAndEndsAtOneExactly) {
  EXPECT_EQ(progress(GetParam(), 0).position, 0);
  EXPECT_EQ(progress(GetParam(), 1).position, 1);
}

TEST_P(EveryLaw, RestsOutsideItsTime) {
  for (const double s : {-kInfinity, -1.0, -1e-300, kNotANumber}) {
    const Progress before = progress(GetParam(), s);
    EXPECT_EQ(before.position, 0);
    EXPECT_EQ(before.velocity, 0);
    EXPECT_EQ(before.acceleration, 0);
  }
  for (const double s : {std::nextafter(1.0, 2.0), 3.0, kInfinity}) {
    const Progress after = progress(GetParam(), s);
    EXPECT_EQ(after.position, 1);
    EXPECT_EQ(after.velocity, 0);
    EXPECT_EQ(after.acceleration, 0);
  }
}

TEST_P(EveryLaw, NeverTurnsBackNorLeavesTheWay) {
  // A cubic is a product, of which rounding shows.
  const double slack = GetParam() == TimeLaw::linearForce ? 2.3e-16 : 0;
  double last = 0;
  for (int i = 0; i <= 10000; ++i) {
    // Adjacent numbers too, between which only rounding could make the position decrease.
    for (double s = i / 10000.0, past = s + 1e-15; s < past; s = std::nextafter(s, 2 * past)) {
      const Progress now = progress(GetParam(), s);
      EXPECT_GE(now.position, last - slack) << "at " << s;
      EXPECT_LE(now.position, 1);
      EXPECT_GE(now.velocity, 0);
      last = now.position;
      if (s == 0) break;
    }
  }
}

TEST_P(EveryLaw, KeepsItsVelocityContinuousInside) {
  constexpr double step = 1e-6;
  for (int i = 1; i < 1000; ++i) {
    const double s = i / 1000.0;
    const double jump =
        progress(GetParam(), s + step).velocity - progress(GetParam(), s - step).velocity;
    EXPECT_LE(std::abs(jump), 2 * step * 6 * 1.001) << "at " << s;
  }
}

TEST_P(EveryLaw, MovesAsItsOwnForceSays) {
  const Motion motion = motionBy(GetParam());
  constexpr int steps = 64;  // even: the force may reverse half-way
  constexpr double h = kSeconds / steps;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const auto acceleration = [&](double time) { return motion.sample(k, time).force / kMass; };
    State q{kFrom[k], motion.sample(k, 0).velocity};
    for (int i = 0; i < steps; ++i) {
      q = gaussStep(q, i * h, h, acceleration);
      const MotionSample closed = motion.sample(k, i + 1 < steps ? (i + 1) * h : kSeconds);
      EXPECT_NEAR(closed.position, q.position, 1e-13);
      EXPECT_NEAR(closed.velocity, q.velocity, 1e-13);
    }
    EXPECT_NEAR(q.position, kTo[k], 1e-13);
  }
}

TEST_P(EveryLaw, HasItsEndsBitForBit) {
  // Values for which from + (to − from) is not exactly `to`, and zeros of both signs.
  const std::vector<double> from{0.1, 1e16, -0.0, 1, 0.3, -0.0, 0.0};
  const std::vector<double> to{0.7, 1.1, 1, -0.0, 1e-300, 0.0, -0.0};
  const Result<Motion> motion = Motion::make(from, to, GetParam(), 0.1);
  ASSERT_TRUE(motion.has_value());
  std::vector<double> weights(from.size());
  const auto expectBits = [&](const std::vector<double>& expected) {
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(weights[k]),
                std::bit_cast<std::uint64_t>(expected[k]));
    }
  };
  for (const double time : {-kInfinity, -1.0, 0.0, kNotANumber}) {
    motion->at(time, weights);
    expectBits(from);
  }
  for (const double time : {0.1, 0.2, kInfinity}) {
    motion->at(time, weights);
    expectBits(to);
  }
}

TEST_P(EveryLaw, GivesTheSameForOneWeightAsForAll) {
  const Motion motion = motionBy(GetParam());
  std::vector<double> weights(motion.size()), velocities(motion.size()), forces(motion.size());
  for (const double time : {-0.1, 0.0, 0.2, kSeconds / 2, 0.6, kSeconds, 0.8}) {
    motion.at(time, weights);
    motion.velocities(time, velocities);
    motion.forces(time, forces);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      const MotionSample sample = motion.sample(k, time);
      EXPECT_EQ(weights[k], sample.position);
      EXPECT_EQ(velocities[k], sample.velocity);
      EXPECT_EQ(forces[k], sample.force);
    }
  }
}

// A vertex is a linear function of the weights, so m x'' is the same function of the forces.
TEST_P(EveryLaw, MovesABlendedVertexByTheSameLaw) {
  const Motion motion = motionBy(GetParam());
  const std::vector<double> displacement{0.5, -2, 0.25, 3, 7};
  const auto blend = [&](const std::vector<double>& weights) {
    double x = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) x += weights[k] * displacement[k];
    return x;
  };
  const double way = blend(kTo) - blend(kFrom);
  std::vector<double> values(motion.size());
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    const Progress done = progress(GetParam(), s);
    motion.at(s * kSeconds, values);
    EXPECT_NEAR(blend(values), blend(kFrom) + way * done.position, 1e-13);
    motion.forces(s * kSeconds, values);
    EXPECT_NEAR(blend(values), kMass * way * done.acceleration / (kSeconds * kSeconds), 1e-11);
  }
}

TEST(Linear, NeedsNoForce) {
  const Motion motion = motionBy(TimeLaw::linear);
  for (const double time : {0.0, 0.3, kSeconds}) {
    EXPECT_EQ(motion.sample(0, time).force, 0);
    EXPECT_DOUBLE_EQ(motion.sample(0, time).velocity, 1 / kSeconds);
  }
}

TEST(Newton, LeavesFromRestUnderTheForceTwoMassTimesTheWayOverTimeSquared) {
  const Motion motion = motionBy(TimeLaw::newton);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const double way = kTo[k] - kFrom[k];
    EXPECT_EQ(motion.sample(k, 0).velocity, 0);
    EXPECT_DOUBLE_EQ(motion.sample(k, kSeconds).velocity, 2 * way / kSeconds);
    for (const double time : {0.0, 0.1, 0.4, kSeconds}) {
      const double s = time / kSeconds;
      EXPECT_NEAR(motion.sample(k, time).position, kFrom[k] + way * s * s, 1e-15);
      EXPECT_DOUBLE_EQ(motion.sample(k, time).force, 2 * kMass * way / (kSeconds * kSeconds));
    }
  }
}

TEST(Brake, ArrivesAtRestUnderTheOppositeForce) {
  const Motion motion = motionBy(TimeLaw::brake);
  EXPECT_DOUBLE_EQ(motion.sample(0, 0).velocity, 2 / kSeconds);
  EXPECT_EQ(motion.sample(0, kSeconds).velocity, 0);
  EXPECT_DOUBLE_EQ(motion.sample(0, 0.3).force, -2 * kMass / (kSeconds * kSeconds));
}

TEST(Brake, IsNewtonPlayedBackwards) {
  for (int i = 0; i <= 1024; ++i) {
    const double s = i / 1024.0;  // 1 − s is exact, and so are the squares
    const Progress brake = progress(TimeLaw::brake, s), newton = progress(TimeLaw::newton, 1 - s);
    EXPECT_EQ(brake.position, 1 - newton.position);
    EXPECT_EQ(brake.velocity, newton.velocity);
    EXPECT_EQ(brake.acceleration, -newton.acceleration);
  }
}

TEST(AccelerateBrake, IsSymmetricAboutItsMiddle) {
  for (int i = 0; i < 512; ++i) {
    const double s = i / 1024.0;
    const Progress early = progress(TimeLaw::accelerateBrake, s);
    const Progress late = progress(TimeLaw::accelerateBrake, 1 - s);
    EXPECT_EQ(early.position, 1 - late.position);
    EXPECT_EQ(early.velocity, late.velocity);
    EXPECT_EQ(early.acceleration, -late.acceleration);
  }
  const Progress middle = progress(TimeLaw::accelerateBrake, 0.5);
  EXPECT_EQ(middle.position, 0.5);
  EXPECT_EQ(middle.velocity, 2);
  EXPECT_EQ(middle.acceleration, -4);
}

TEST(AccelerateBrake, GoesFromRestToRestUnderTwoForces) {
  const Motion motion = motionBy(TimeLaw::accelerateBrake);
  const double force = 4 * kMass / (kSeconds * kSeconds);
  EXPECT_EQ(motion.sample(0, 0).velocity, 0);
  EXPECT_EQ(motion.sample(0, kSeconds).velocity, 0);
  EXPECT_DOUBLE_EQ(motion.sample(0, 0.34).force, force);
  EXPECT_DOUBLE_EQ(motion.sample(0, 0.36).force, -force);
}

TEST(Motion, ForceGrowsWithTheMassAndTheWeightsDoNotCare) {
  const Result<Motion> light = Motion::make(kFrom, kTo, TimeLaw::newton, 1);
  const Result<Motion> heavy = Motion::make(kFrom, kTo, TimeLaw::newton, 1, 8);
  ASSERT_TRUE(light && heavy);
  EXPECT_EQ(light->mass(), 1);
  EXPECT_EQ(heavy->sample(1, 0.4).force, 8 * light->sample(1, 0.4).force);
  EXPECT_EQ(heavy->sample(1, 0.4).position, light->sample(1, 0.4).position);
}

TEST(Motion, WritesNoMoreThanThereIsRoomFor) {
  const Motion motion = motionBy(TimeLaw::newton);
  std::vector<double> shorter(2, -1), longer(motion.size() + 1, -1);
  motion.at(kSeconds, shorter);
  motion.at(kSeconds, longer);
  EXPECT_EQ(shorter, (std::vector<double>{1, 0.75}));
  EXPECT_EQ(longer.back(), -1);
}

TEST(Motion, MayMoveNothing) {
  const Result<Motion> motion = Motion::make({}, {}, TimeLaw::newton, 1);
  ASSERT_TRUE(motion.has_value());
  EXPECT_EQ(motion->size(), 0u);
  motion->at(0.5, {});
}

TEST(MotionRefuses, EndsOfDifferentSizes) {
  const Result<Motion> motion = Motion::make(kFrom, std::vector<double>{1}, TimeLaw::linear, 1);
  ASSERT_FALSE(motion.has_value());
  EXPECT_EQ(motion.error().message,
            "The motion starts with 5 weights and ends with 1; give both ends the same weights.");
}

TEST(MotionRefuses, TimesAndMassesThatAreNotPositive) {
  for (const double bad : {0.0, -0.0, -1.0, kInfinity, kNotANumber}) {
    const Result<Motion> time = Motion::make(kFrom, kTo, TimeLaw::linear, bad);
    ASSERT_FALSE(time.has_value());
    EXPECT_EQ(time.error().message, "The motion must last a finite time greater than 0 seconds.");
    const Result<Motion> mass = Motion::make(kFrom, kTo, TimeLaw::linear, 1, bad);
    ASSERT_FALSE(mass.has_value());
    EXPECT_EQ(mass.error().message, "The mass of the motion must be finite and greater than 0.");
  }
}

TEST(MotionRefuses, WeightsThatAreNotFinite) {
  const std::vector<double> good{0, 0};
  for (const double bad : {kInfinity, -kInfinity, kNotANumber}) {
    const std::vector<double> weights{0, bad};
    EXPECT_FALSE(Motion::make(good, weights, TimeLaw::linear, 1).has_value());
    const Result<Motion> motion = Motion::make(weights, good, TimeLaw::linear, 1);
    ASSERT_FALSE(motion.has_value());
    EXPECT_EQ(motion.error().message, "Weight 1 of the motion is not a finite number.");
  }
}

TEST(MotionRefuses, SpeedsAndForcesThatOverflow) {
  const std::vector<double> low{-kLargest}, high{kLargest}, zero{0}, one{1};
  EXPECT_FALSE(Motion::make(low, high, TimeLaw::linear, 1).has_value());
  EXPECT_FALSE(Motion::make(zero, one, TimeLaw::newton, 1e-200).has_value());
  EXPECT_FALSE(Motion::make(zero, one, TimeLaw::newton, 1, kLargest).has_value());
  const Result<Motion> motion = Motion::make(zero, one, TimeLaw::newton, 1e-320);
  ASSERT_FALSE(motion.has_value());
  EXPECT_EQ(motion.error().message.find("Weight 0 of the motion moves too fast"), 0u);
}

TEST(TimeLawNames, ListThemselvesWhereANameIsUnknown) {
  for (const std::string name : {"", "Newton", "ease"}) {
    const Result<TimeLaw> law = timeLawFromName(name);
    ASSERT_FALSE(law.has_value());
    EXPECT_EQ(law.error().message, "There is no time law \"" + name +
                                       "\"; the laws are linear, newton, brake, accelerate-brake, "
                                       "linear-force.");
  }
}

}  // namespace
}  // namespace sweepface
