#include "sweepface/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace sweepface {
namespace {

using Real = long double;
using Acceleration = std::function<Real(Real t, Real x, Real v)>;

/// Integrates x″ = a(t, x, v) by Richardson's extrapolation of the classical Runge–Kutta method.
Kinematics integrate(const Acceleration& a, Start start, double seconds) {
  const auto run = [&](int steps) {
    Real x = start.position, v = start.velocity, t = 0;
    const Real h = static_cast<Real>(seconds) / steps;
    for (int i = 0; i < steps; ++i, t = i * h) {
      const Real k1 = v, l1 = a(t, x, v);
      const Real k2 = v + h / 2 * l1, l2 = a(t + h / 2, x + h / 2 * k1, v + h / 2 * l1);
      const Real k3 = v + h / 2 * l2, l3 = a(t + h / 2, x + h / 2 * k2, v + h / 2 * l2);
      const Real k4 = v + h * l3, l4 = a(t + h, x + h * k3, v + h * l3);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    return std::array{x, v};
  };
  const auto coarse = run(2000), fine = run(4000);
  return {static_cast<double>(fine[0] + (fine[0] - coarse[0]) / 15),
          static_cast<double>(fine[1] + (fine[1] - coarse[1]) / 15), 0};
}

class Random {
 public:
  double operator()(double low, double high) {
    return std::uniform_real_distribution(low, high)(engine_);
  }

 private:
  std::mt19937 engine_{7};
};

Trajectory made(const Result<Trajectory>& trajectory) {
  EXPECT_TRUE(trajectory) << trajectory.error().message;
  return trajectory.value_or(Trajectory(std::numeric_limits<double>::quiet_NaN()));
}

void expectNear(const Kinematics& found, const Kinematics& wanted, double scale, double relative) {
  EXPECT_NEAR(found.position, wanted.position, relative * scale);
  EXPECT_NEAR(found.velocity, wanted.velocity, relative * scale);
}

TEST(Trajectory, RestsByDefault) {
  const Kinematics k = Trajectory(0.3).at(5);
  EXPECT_EQ(k.position, 0.3);
  EXPECT_EQ(k.velocity, 0);
}

TEST(Trajectory, TheLawsAreSpecialCases) {
  for (const TimeLaw law : timeLaws)
    for (double s = 0; s <= 1; s += 1.0 / 64) {
      const Progress wanted = progress(law, s);
      const Kinematics found = made(Trajectory::byLaw(law, -1, 2, 0.5)).at(0.5 * s);
      EXPECT_NEAR(found.position, -1 + 3 * wanted.position, 1e-14) << nameOf(law) << " at " << s;
      EXPECT_NEAR(found.velocity, 6 * wanted.velocity, 1e-13) << nameOf(law) << " at " << s;
      EXPECT_NEAR(found.acceleration, 12 * wanted.acceleration, 1e-12) << nameOf(law) << s;
    }
}

TEST(Trajectory, ForcesArriveInTimeFromAnyVelocity) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Start start{random(-2, 2), random(-9, 9)};
    const double to = random(-2, 2), seconds = random(0.05, 3), end = random(-5, 5);
    const auto expectEnd = [&](const Trajectory& t, double velocity) {
      EXPECT_NEAR(t.at(seconds).position, to, 1e-11);
      EXPECT_NEAR(t.at(seconds).velocity, velocity, 1e-11 * (1 + std::abs(velocity)) * 100);
      EXPECT_EQ(t.at(0).position, start.position);
      EXPECT_EQ(t.at(0).velocity, start.velocity);
      EXPECT_EQ(t.at(2 * seconds).position, to);
      EXPECT_EQ(t.at(2 * seconds).velocity, 0);
    };
    expectEnd(made(Trajectory::constantForce(start, to, seconds)),
              2 * (to - start.position) / seconds - start.velocity);
    expectEnd(made(Trajectory::linearForce(start, to, seconds, end)), end);
    expectEnd(made(Trajectory::twoForces(start, to, seconds, random(0.1, 0.9))), 0);
  }
}

TEST(Trajectory, TwoForcesDoNotJumpAtTheirTurn) {
  const Trajectory t = made(Trajectory::twoForces({0.2, 3}, 1, 2, 0.3));
  const Kinematics before = t.at(0.6 - 1e-12), after = t.at(0.6 + 1e-12);
  EXPECT_NEAR(before.position, after.position, 1e-10);
  EXPECT_NEAR(before.velocity, after.velocity, 1e-10);
}

TEST(Trajectory, SpringsAgreeWithIntegration) {
  Random random;
  for (int i = 0; i < 200; ++i) {
    // Critical and nearly critical damping are the hard cases.
    const double damping = i % 4 == 0 ? 1 : i % 4 == 1 ? 1 + random(-1e-6, 1e-6) : random(0, 4);
    const Spring spring{random(0.2, 3), damping};
    const Start start{random(-2, 2), random(-5, 5)};
    const double to = random(-2, 2), seconds = random(0.01, 2);
    const Real omega = 2 * std::numbers::pi_v<Real> * spring.frequency;
    const Kinematics wanted = integrate(
        [&](Real, Real x, Real v) { return -2 * damping * omega * v - omega * omega * (x - to); },
        start, seconds);
    expectNear(made(Trajectory::spring(start, to, spring)).at(seconds), wanted, 40, 1e-11);
  }
}

TEST(Trajectory, StiffAndCreepingSpringsStaySane) {
  for (const double damping : {0.0, 0.999999999, 1.0, 1.000000001, 50.0, 1e5})
    for (const double frequency : {1e-4, 1.0, 1e4}) {
      const Trajectory t = made(Trajectory::spring({1, 0}, 0, {frequency, damping}));
      for (const double time : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
        const double x = t.at(time).position;
        EXPECT_LE(std::abs(x), 1 + 1e-9) << damping << ' ' << frequency << ' ' << time;
      }
    }
}

TEST(Trajectory, ASpringsSwingsHalveEveryHalfLife) {
  const Spring spring = Spring::withHalfLife(0.2, 0.1);
  const Trajectory t = made(Trajectory::spring({1, 0}, 0, spring));
  const double turn = 1 / (spring.frequency * std::sqrt(1 - 0.01));  // one swing
  EXPECT_NEAR(t.at(turn).position, std::exp2(-turn / 0.2), 1e-12);
}

TEST(Trajectory, ACreepingSpringHalvesEveryHalfLifeInTheEnd) {
  const Trajectory t = made(Trajectory::spring({1, 0}, 0, Spring::withHalfLife(0.5, 3)));
  EXPECT_NEAR(t.at(3.5).position / t.at(3).position, 0.5, 1e-6);
}

TEST(Trajectory, ForEverIsWhereItEnds) {
  const double ever = std::numeric_limits<double>::infinity();
  for (const double damping : {0.001, 0.5, 1.0, 3.0})
    for (const double time : {ever, 1e308})
      EXPECT_EQ(Trajectory::spring({0, 3}, 1, {2, damping})->at(time).position, 1);
  EXPECT_EQ(made(Trajectory::spring({0, 1}, 2, {})).at(ever).position, 2);
  EXPECT_EQ(made(Trajectory::impulse({3, 0}, 0, 0)).at(ever).position, 3);
}

TEST(Trajectory, SplittingTimeGivesTheSameState) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Spring spring{random(0.2, 3), random(0, 3)};
    const double first = random(0, 1), second = random(0, 1), to = random(-1, 1);
    const Trajectory whole = made(Trajectory::spring({0.5, random(-3, 3)}, to, spring));
    const Kinematics half = whole.at(first);
    const Trajectory rest = made(Trajectory::spring({half.position, half.velocity}, to, spring));
    expectNear(rest.at(second), whole.at(first + second), 20, 1e-13);
  }
}

TEST(Trajectory, BouncesLoseSpeedByTheirRestitution) {
  const Trajectory t = made(Trajectory::bounce({0, 0}, 1, 0.5, 0.6));
  EXPECT_NEAR(t.at(0.25).position, 0.25, 1e-15);  // falls by s²
  // Impact speeds 4, 2.4, 1.44 …; a flight lasts 2 v / a with a = 8.
  double time = 0.5, speed = 4;
  for (int n = 0; n < 20; ++n) {
    EXPECT_NEAR(t.at(time).position, 1, 1e-9) << n;
    EXPECT_NEAR(t.at(time - 1e-9).velocity, speed, 1e-6) << n;
    speed *= 0.6;
    EXPECT_NEAR(t.at(time + 1e-9).velocity, -speed, 1e-6) << n;
    EXPECT_NEAR(t.at(time + speed / 8).position, 1 - speed * speed / 16, 1e-9) << n;
    time += 2 * speed / 8;
  }
  EXPECT_EQ(t.at(0.5 + 2 * 0.6 * 4 / 8 / 0.4 + 1e-6).position, 1);
  EXPECT_EQ(t.at(1e9).velocity, 0);
}

TEST(Trajectory, WhatIsTooQuickToFallTowardsItsGoalStopsThere) {
  const Trajectory t = made(Trajectory::bounce({0, 3}, 1, 0.5, 0.6));  // it arrives at speed 1
  for (const double time : {0.6, 10.0}) {
    EXPECT_EQ(t.at(time).position, 1) << time;
    EXPECT_EQ(t.at(time).velocity, 0) << time;
  }
}

TEST(Trajectory, BouncesNeverPassTheirGoal) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const double seconds = random(0.1, 2), restitution = random(0, 0.99);
    const Trajectory t = made(Trajectory::bounce({0, 0}, 1, seconds, restitution));
    for (int k = 0; k < 200; ++k) EXPECT_LE(t.at(random(0, 20)).position, 1 + 1e-9) << restitution;
  }
}

TEST(Trajectory, ABlowIsSlowedByDrag) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Start start{random(-1, 1), random(-2, 2)};
    const double impulse = random(-5, 5), drag = i % 5 ? random(0, 8) : 0, time = random(0.01, 3);
    const Trajectory t = made(Trajectory::impulse(start, impulse, drag));
    const Kinematics wanted = integrate([&](Real, Real, Real v) { return -drag * v; },
                                        {start.position, start.velocity + impulse}, time);
    expectNear(t.at(time), wanted, 20, 1e-11);
    EXPECT_NEAR(t.at(time).acceleration, -drag * wanted.velocity, 1e-9);
  }
}

TEST(Trajectory, PeriodicForcesAgreeWithIntegrationAndArrive) {
  Random random;
  for (int i = 0; i < 25; ++i) {
    std::array<Harmonic, 4> harmonics;
    for (Harmonic& h : harmonics) h = {random(-9, 9), random(-9, 9)};
    const Start start{random(-1, 1), random(-2, 2)};
    const double to = random(-1, 1), seconds = random(0.2, 3), period = random(0.2, 3);
    const Trajectory t = made(Trajectory::periodicForce(start, to, seconds, period, harmonics));
    EXPECT_NEAR(t.at(seconds).position, to, 1e-10);
    EXPECT_EQ(t.at(seconds + 1).position, to);
    const double time = random(0.01, 1) * seconds;
    double constant = t.at(0).acceleration;
    for (const Harmonic& h : harmonics) constant -= h.cosine;
    const auto force = [&](Real s, Real, Real) {
      Real sum = constant;
      for (std::size_t k = 0; k < harmonics.size(); ++k) {
        const Real angle = 2 * std::numbers::pi_v<Real> * (k + 1) * s / period;
        sum += harmonics[k].cosine * std::cos(angle) + harmonics[k].sine * std::sin(angle);
      }
      return sum;
    };
    expectNear(t.at(time), integrate(force, start, time), 100, 1e-11);
    EXPECT_NEAR(t.at(time).acceleration, static_cast<double>(force(time, 0, 0)), 1e-11);
  }
}

TEST(Trajectory, PeriodsFarLongerThanTheMoveKeepTheirDigits) {
  const std::array<Harmonic, 1> sine{{{0, 6}}};
  for (const double period : {100.0, 1e3, 1e6, 1e12}) {
    const Trajectory t = made(Trajectory::periodicForce({0, 0}, 1, 1, period, sine));
    // f = a + 6 sin wt; for long periods the first three terms of the sine's series suffice.
    const double w = 2 * std::numbers::pi / period, mean = t.at(0).acceleration, s = 0.5;
    const double way = w * s * s * s / 6 * (1 - w * w * s * s / 20 * (1 - w * w * s * s / 42));
    EXPECT_NEAR(t.at(s).position, mean * s * s / 2 + 6 * way, 1e-14) << period;
    EXPECT_NEAR(t.at(1).position, 1, 1e-14);
  }
}

TEST(Trajectory, ASpringMovesUntilItStaysWithinATolerance) {
  constexpr double tolerance = 0.01, step = 1e-3, goal = 2;
  for (const double damping : {0.1, 0.5, 0.9, 1.0, 3.0}) {
    for (const Start start : {Start{0, 0}, Start{2, -9}, Start{1, 30}}) {
      const Trajectory t = made(Trajectory::spring(start, goal, {1.5, damping}));
      double lastMoving = 0, lastOutside = 0;
      for (double time = 0; time < 20; time += step) {
        if (t.moves(time, tolerance)) lastMoving = time;
        if (std::abs(t.at(time).position - goal) > tolerance) lastOutside = time;
      }
      EXPECT_GE(lastMoving, lastOutside) << damping;
      // An oscillating spring stops by its next turning point, a creeping one before its distance
      // is less than tolerance / √2.
      if (damping < 1)
        EXPECT_LE(lastMoving, lastOutside + step + 0.5 / 1.5 / std::sqrt(1 - damping * damping));
      else
        EXPECT_GT(std::abs(t.at(lastMoving).position - goal), tolerance / 1.5) << damping;
    }
  }
}

TEST(Trajectory, ASpringWithoutADamperMovesForEver) {
  const Trajectory t = made(Trajectory::spring({0, 0}, 0.01, {2, 0}));
  for (const double time : {0.0, 0.125, 0.25, 1e3, 1e9}) {
    EXPECT_TRUE(t.moves(time, 0.00999)) << time;
    EXPECT_FALSE(t.moves(time, 0.01001)) << time;
  }
}

TEST(Trajectory, WhatArrivesMovesUntilThen) {
  const std::array<Harmonic, 1> sine{{{0, 6}}};
  for (const Trajectory& t :
       {made(Trajectory::constantForce({0, 3}, 1, 0.5)),
        made(Trajectory::linearForce({1, 3}, 1, 0.5)), made(Trajectory::twoForces({0, 3}, 1, 0.5)),
        made(Trajectory::bounce({0, 0}, 1, 0.5, 0)),
        made(Trajectory::periodicForce({0, 0}, 1, 0.5, 0.1, sine))}) {
    EXPECT_TRUE(t.moves(-1, 1e-6));
    EXPECT_TRUE(t.moves(0.499, 1e-6));
    EXPECT_FALSE(t.moves(0.5, 1e-6));
    EXPECT_FALSE(t.moves(std::numeric_limits<double>::infinity(), 0));
  }
  EXPECT_FALSE(Trajectory(3).moves(0, 0));
}

TEST(Trajectory, WhatBouncesMovesUntilTheLastTime) {
  // It accelerates by 8 and arrives at speed 4; each flight lasts half as long as the one before.
  const Trajectory t = made(Trajectory::bounce({0, 0}, 1, 0.5, 0.5));
  const double rest = 0.5 + 2 * 0.5 * 4 / 8 / (1 - 0.5);
  EXPECT_TRUE(t.moves(0.5, 1e-6));
  EXPECT_TRUE(t.moves(rest - 1e-3, 1e-6));
  EXPECT_FALSE(t.moves(rest + 1e-9, 1e-6));
}

TEST(Trajectory, ABlowMovesAsFarAsItsDragLets) {
  const Trajectory t = made(Trajectory::impulse({0, 1}, 1, 4));
  const double reach = t.at(1e9).position;
  for (const double time : {0.0, 0.5, 2.0}) {
    const double left = reach - t.at(time).position;
    EXPECT_TRUE(t.moves(time, 0.999 * left)) << time;
    EXPECT_FALSE(t.moves(time, 1.001 * left)) << time;
  }
  EXPECT_TRUE(made(Trajectory::impulse({0, 0}, -1e-9, 0)).moves(1e9, 1));
  EXPECT_FALSE(made(Trajectory::impulse({0, 1}, -1, 0)).moves(0, 0));
}

TEST(Trajectory, NoToleranceIsNone) {
  const Trajectory t = made(Trajectory::spring({0, 0}, 1, {}));
  for (const double none : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(t.moves(3, none));
}

TEST(Trajectory, TimesBeforeTheStartAndNoTimeAtAllAreTheStart) {
  const Trajectory t = made(Trajectory::spring({0.25, 1}, 1, {}));
  EXPECT_EQ(t.at(-3).position, 0.25);
  EXPECT_EQ(t.at(std::numeric_limits<double>::quiet_NaN()).position, 0.25);
}

TEST(Trajectory, RefusesWhatHasNoMeaning) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Trajectory::constantForce({0, 0}, 1, 0));
  EXPECT_FALSE(Trajectory::constantForce({0, nan}, 1, 1));
  EXPECT_FALSE(Trajectory::constantForce({0, 0}, infinite, 1));
  EXPECT_FALSE(Trajectory::constantForce({0, 0}, 1e308, 1e-300));
  EXPECT_FALSE(Trajectory::linearForce({0, 0}, 1, 1, nan));
  EXPECT_FALSE(Trajectory::twoForces({0, 0}, 1, 1, 0));
  EXPECT_FALSE(Trajectory::twoForces({0, 0}, 1, 1, 1));
  EXPECT_FALSE(Trajectory::twoForces({0, 0}, 1e308, 1e-300, 0.5));
  EXPECT_FALSE(Trajectory::spring({0, 0}, 1, {0, 1}));
  EXPECT_FALSE(Trajectory::spring({0, 0}, 1, {1, -0.1}));
  EXPECT_FALSE(Trajectory::bounce({0, 0}, 1, 1, 1));
  EXPECT_FALSE(Trajectory::bounce({0, 0}, 1, -1, 0.5));
  EXPECT_FALSE(Trajectory::bounce({0, 0}, 1, 1, 1 - 1e-14));
  EXPECT_FALSE(Trajectory::spring({-1e308, 0}, 1e308, {}));
  EXPECT_FALSE(Trajectory::spring({0, 0}, 1.2e306, {8, 1}));
  EXPECT_FALSE(Trajectory::spring({0, 1e307}, 1, {8, 1}));
  EXPECT_FALSE(Trajectory::impulse({0, 0}, 1, -1));
  EXPECT_FALSE(Trajectory::impulse({0, 1e308}, 1e308, 0));
  EXPECT_FALSE(Trajectory::periodicForce({0, 0}, 1, 1, 0, {}));
  const std::array<Harmonic, 9> many{};
  EXPECT_FALSE(Trajectory::periodicForce({0, 0}, 1, 1, 1, many));
}

}  // namespace
}  // namespace sweepface
