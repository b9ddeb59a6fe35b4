#include "sweepface/trajectory.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "ode/elementary.hpp"

namespace sweepface {
namespace {

Result<void> checkNumbers(std::initializer_list<double> numbers) {
  for (const double x : numbers)
    if (!std::isfinite(x))
      return failCall(
          "A motion needs finite numbers; its goal, time or frequency is beyond what they hold.");
  return {};
}

Result<void> checkSeconds(double seconds) {
  if (std::isfinite(seconds) && seconds > 0) return {};
  return failCall("The motion must last a finite time greater than 0 seconds.");
}

Result<void> check(Start start, double to, double seconds) {
  if (auto ok = checkSeconds(seconds); !ok) return ok;
  return checkNumbers({start.position, start.velocity, to});
}

// NaN counts as before the start, infinity as a very long time.
double sinceStart(double time) {
  return time > 0 ? std::fmin(time, std::numeric_limits<double>::max()) : 0;
}

}  // namespace

using path::Cubic;

Spring Spring::withHalfLife(double seconds, double damping) {
  // Swings lie within e^(−ζωt); beyond critical damping the slower of two decays is the one that
  // remains.
  const double slow = damping > 1 ? 1 / (damping + std::sqrt(damping * damping - 1)) : damping;
  return {std::numbers::ln2 / (2 * std::numbers::pi * slow * seconds), damping};
}

// ---- Evaluation ----

Kinematics path::Cubic::at(double t) const noexcept {
  return {x + t * (v + t * (a / 2 + t * (jerk / 6))), v + t * (a + t * (jerk / 2)), a + t * jerk};
}

Kinematics path::Pieces::at(double t) const noexcept {
  if (t > end) return {goal, 0, 0};
  return t < turn ? first.at(t) : second.at(t - turn);
}

// With y = x − goal, y = E C y₀ + E S (v₀ + σ y₀), where E = e^(−σt) and C, S are cos(wt) and
// sin(wt)/w, or cosh and sinh/w beyond critical damping; w² = |ω² − σ²|.
path::Swing::Decay path::Swing::decay(double t) const noexcept {
  const double difference = (omega - sigma) * (omega + sigma);
  const double w = std::sqrt(std::abs(difference));
  const double angle = std::fmin(w * t, std::numeric_limits<double>::max());
  double c, s;
  if (angle < 1e-8) {
    c = ode::exponential(-sigma * t);
    s = c * t;
  } else if (difference > 0) {
    const auto [sine, cosine] = ode::sineCosine(angle);
    const double shrink = ode::exponential(-sigma * t);
    c = shrink * cosine;
    s = shrink * sine / w;
  } else {
    // σ − w cancels when w is nearly σ; ω² / (σ + w) does not.
    const double slow = ode::exponential(-omega * omega / (sigma + w) * t);
    const double shrink = ode::exponential(-2 * angle);
    c = slow * (1 + shrink) / 2;
    s = slow * -ode::exponentialLess1(-2 * angle) / (2 * w);
  }
  return {c, s};
}

Kinematics path::Swing::at(double t) const noexcept {
  const Kinematics way = wayAfter(decay(t), {x - goal, v});
  return {goal + way.position, way.velocity, way.acceleration};
}

// Bounce n leaves the goal with speed eⁿ v and lasts 2 eⁿ v / a: the times form a geometric series.
Kinematics path::Bounces::at(double t) const noexcept {
  if (t < end) return fall.at(t);
  if (!(speed * fall.a > 0) || restitution == 0) return {goal, 0, 0};
  const double e = restitution, first = 2 * e * speed / fall.a, since = t - end;
  const double left = 1 - since * (1 - e) / first;  // eⁿ⁻¹ of bounce n, interpolated
  if (!(left > 0)) return {goal, 0, 0};
  const double n = std::floor(ode::logarithm(left) / ode::logarithm(e));
  const double power = ode::exponential(n * ode::logarithm(e)),
               began = first * (1 - power) / (1 - e);
  const double s = std::fmin(std::fmax(since - began, 0), first * power), up = -e * power * speed;
  return {goal + s * (up + s * fall.a / 2), up + s * fall.a, fall.a};
}

Kinematics path::Coasting::at(double t) const noexcept {
  const double way = drag > 0 ? -ode::exponentialLess1(-drag * t) / drag : t;
  const double velocity = drag > 0 ? v * ode::exponential(-drag * t) : v;
  return {x + v * way, velocity, -drag * velocity};
}

Kinematics Trajectory::at(double time) const noexcept {
  const double t = sinceStart(time);
  return std::visit([t](const auto& form) { return form.at(t); }, path_);
}

// ---- Rest ----

bool path::Pieces::moves(double t, double) const noexcept { return t < end; }

// Its energy only falls, so that no later distance from the goal exceeds √(y² + (y′/ω)²).
bool path::Swing::moves(double t, double tolerance) const noexcept {
  const Kinematics way = wayAfter(decay(t), {x - goal, v});
  const double swing = way.velocity / omega;
  return way.position * way.position + swing * swing > tolerance * tolerance;
}

bool path::Bounces::moves(double t, double) const noexcept {
  return t < end || at(t).acceleration != 0;
}

bool path::Coasting::moves(double t, double tolerance) const noexcept {
  return drag > 0 ? std::abs(v) * ode::exponential(-drag * t) / drag > tolerance : v != 0;
}

bool path::Driven::moves(double t, double) const noexcept { return t < end; }

bool Trajectory::moves(double time, double tolerance) const noexcept {
  const double t = sinceStart(time), least = std::fmax(tolerance, 0);
  return std::visit([=](const auto& form) { return form.moves(t, least); }, path_);
}

// ---- Making ----

Trajectory::Trajectory(double position)
    : path_(path::Pieces{{.x = position}, {.x = position}, 0, 0, position}) {}

Result<Trajectory> Trajectory::pieces(const Cubic& first, double end, double goal) {
  if (auto ok = checkNumbers({first.x, first.v, first.a, first.jerk, goal}); !ok)
    return std::unexpected(ok.error());
  return Trajectory(path::Pieces{first, {}, std::numeric_limits<double>::infinity(), end, goal});
}

Result<Trajectory> Trajectory::byLaw(TimeLaw law, double from, double to, double seconds) {
  const double speed = (to - from) / seconds;
  switch (law) {
    case TimeLaw::newton:
      return constantForce({from, 0}, to, seconds);
    case TimeLaw::brake:
      return constantForce({from, 2 * speed}, to, seconds);
    case TimeLaw::accelerateBrake:
      return twoForces({from, 0}, to, seconds);
    case TimeLaw::linearForce:
      return linearForce({from, 0}, to, seconds);
    case TimeLaw::linear:
      break;
  }
  return constantForce({from, speed}, to, seconds);
}

Result<Trajectory> Trajectory::constantForce(Start start, double to, double seconds) {
  if (auto ok = check(start, to, seconds); !ok) return std::unexpected(ok.error());
  const double speed = (to - start.position) / seconds;
  return pieces({start.position, start.velocity, 2 * (speed - start.velocity) / seconds, 0},
                seconds, to);
}

Result<Trajectory> Trajectory::linearForce(Start start, double to, double seconds,
                                           double endVelocity) {
  if (auto ok = check(start, to, seconds); !ok) return std::unexpected(ok.error());
  const double speed = (to - start.position) / seconds, v0 = start.velocity, v1 = endVelocity;
  return pieces({start.position, v0, (6 * speed - 4 * v0 - 2 * v1) / seconds,
                 6 * (v0 + v1 - 2 * speed) / (seconds * seconds)},
                seconds, to);
}

// Velocity 0 and position `to` at the end are two linear equations for the two forces.
Result<Trajectory> Trajectory::twoForces(Start start, double to, double seconds, double turn) {
  if (auto ok = check(start, to, seconds); !ok) return std::unexpected(ok.error());
  if (!(turn > 0 && turn < 1))
    return failCall("The force must turn after the start and before the end: between 0 and 1.");
  const double speed = (to - start.position) / seconds, v = start.velocity;
  // The velocity at the turn: the mean of v, peak and 0 over the two parts is the mean speed.
  const double peak = 2 * speed - turn * v;
  const Cubic first{start.position, v, (peak - v) / (turn * seconds), 0};
  const Cubic second{first.at(turn * seconds).position, peak, -peak / ((1 - turn) * seconds), 0};
  if (auto ok = checkNumbers({first.a, second.x, second.a}); !ok)
    return std::unexpected(ok.error());
  return Trajectory(path::Pieces{first, second, turn * seconds, seconds, to});
}

Result<Trajectory> Trajectory::spring(Start start, double to, Spring spring) {
  const double omega = 2 * std::numbers::pi * spring.frequency, sigma = spring.damping * omega;
  const double way = start.position - to;
  if (auto ok = checkNumbers({way, start.velocity, to, sigma * sigma, omega * omega,
                              (sigma * sigma + omega * omega) * way, 2 * sigma * start.velocity});
      !ok)
    return std::unexpected(ok.error());
  if (!(spring.frequency > 0) || !(spring.damping >= 0))
    return failCall("A spring needs a frequency greater than 0 and a damping of at least 0.");
  return Trajectory(path::Swing{to, start.position, start.velocity, sigma, omega});
}

Result<Trajectory> Trajectory::bounce(Start start, double to, double seconds, double restitution) {
  constexpr double kMost = 1 - 1e-9;  // beyond it the sum over all bounces loses precision
  if (!(restitution >= 0 && restitution <= kMost))
    return failCall("A bounce keeps part of its speed: the restitution lies in [0, 1 - 1e-9].");
  const Result<Trajectory> fall = constantForce(start, to, seconds);
  if (!fall) return fall;
  const Cubic first = std::get<path::Pieces>(fall->path_).first;
  return Trajectory(path::Bounces{first, seconds, to, first.v + first.a * seconds, restitution});
}

Result<Trajectory> Trajectory::impulse(Start start, double velocityChange, double drag) {
  if (auto ok = checkNumbers({start.position, start.velocity + velocityChange, drag}); !ok)
    return std::unexpected(ok.error());
  if (drag < 0) return failCall("The drag must be at least 0.");
  return Trajectory(path::Coasting{start.position, start.velocity + velocityChange, drag});
}

Result<Trajectory> Trajectory::periodicForce(Start start, double to, double seconds, double period,
                                             std::span<const Harmonic> harmonics) {
  if (auto ok = check(start, to, seconds); !ok) return std::unexpected(ok.error());
  if (auto ok = checkSeconds(period); !ok)
    return failCall("The period of a force must be greater than 0.");
  if (harmonics.size() > kMostHarmonics)
    return failCall("A periodic force has at most 8 harmonics.");
  path::Driven driven{{}, seconds, to, 2 * std::numbers::pi / period, harmonics.size(), {}};
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    if (auto ok = checkNumbers({harmonics[k].cosine, harmonics[k].sine}); !ok)
      return std::unexpected(ok.error());
    driven.harmonics[k] = harmonics[k];
  }
  const double alone = driven.periodic(seconds).position;
  const Result<Trajectory> mean = constantForce(start, to - alone, seconds);
  if (!mean) return mean;
  driven.mean = std::get<path::Pieces>(mean->path_).first;
  return Trajectory(driven);
}

}  // namespace sweepface
