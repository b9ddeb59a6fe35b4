#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "sweepface/spring_bank.hpp"
#include "sweepface/trajectory.hpp"

namespace sweepface {

/// How a weight moves to a goal from its current position and velocity.
struct Drive {
  enum class Kind {
    cut,              ///< jumps there at once: follows exactly
    newton,           ///< a constant force, arriving at speed
    linearForce,      ///< a force linear in time, arriving at rest
    accelerateBrake,  ///< one constant force, then another, arriving at rest
    spring,           ///< pulled by a spring
    bounce,           ///< a constant force, then bounces
  };
  Kind kind = Kind::spring;
  double seconds = 0.3;      ///< until it arrives: newton, linearForce, accelerateBrake, bounce
  double turn = 0.5;         ///< accelerateBrake: when the second force takes over, as a fraction
  Spring spring{};           ///< spring
  double restitution = 0.4;  ///< bounce
  double delay = 0;          ///< seconds before it sets out
};

/// The drive called "cut", "newton", "linear-force", "accelerate-brake", "spring" or "bounce", with
/// its defaults; the error lists the names.
Result<Drive> driveFromName(std::string_view name);
std::string_view nameOf(Drive::Kind kind) noexcept;

/// The trajectory of a drive without its delay. A cut keeps no velocity.
Result<Trajectory> trajectoryOf(const Drive& drive, Start start, double goal);

/// The most that may pass at once, some 300 years: beyond that a clock could not tell frames apart.
/// More comes from a clock in other units, or from a first frame without a frame before it.
inline constexpr double kMostSeconds = 1e10;

/// K weights in motion. They take new goals at any instant and go on from where they are, without a
/// jump in position or velocity (except for cuts). Every path is a closed form of the time, so the
/// result does not depend on the frame rate. After `make` nothing allocates except error messages.
class MotionState {
 public:
  /// Refuses weights that are not finite.
  static Result<MotionState> make(std::span<const double> weights);

  std::size_t size() const noexcept { return coordinates_.size(); }
  double now() const noexcept { return now_; }  ///< seconds since `make`

  /// Lets time pass: none if `seconds` is negative, not a number or more than kMostSeconds.
  void advance(double seconds) noexcept;

  /// Sends a weight to a goal. What it did before goes on until the drive sets out; an earlier
  /// drive that is still waiting to set out is dropped. On an error nothing changes.
  Result<void> moveTo(std::size_t weight, double goal, const Drive& drive = {});
  /// Whether that would fail.
  Result<void> check(std::size_t weight, double goal, const Drive& drive) const;
  /// The same for all weights [K].
  Result<void> moveTo(std::span<const double> goals, const Drive& drive = {});
  /// An impulse: adds to a weight's velocity, which drag (per second) then takes away.
  Result<void> push(std::size_t weight, double velocityChange, double drag);
  /// The trajectory that a push would give the weight.
  Result<Trajectory> pushed(std::size_t weight, double velocityChange, double drag) const;

  /// The state of a weight; at rest at 0 if there is no such weight.
  Kinematics sample(std::size_t weight) const noexcept;
  /// All weights or velocities, as many as `out` takes.
  void positions(std::span<double> out) const noexcept;
  void velocities(std::span<double> out) const noexcept;
  /// Whether any weight waits to set out, or may still be further than `tolerance` from where it
  /// comes to rest. If none does, there is nothing to evaluate until you ask something new of the
  /// motion.
  bool moves(double tolerance = 1e-6) const noexcept;

 private:
  // What a weight does now and what it does from `switchAt` on.
  struct Coordinate {
    Trajectory now, next;
    double began = 0, switchAt = 0;
    Kinematics at(double time) const noexcept;
  };
  Result<Trajectory> prepare(std::size_t weight, double goal, const Drive& drive) const;
  void take(std::size_t weight, const Trajectory& next, double delay) noexcept;

  void notePull(std::size_t weight) noexcept;
  Kinematics at(std::size_t weight, double time) const noexcept;

  std::vector<Coordinate> coordinates_;
  SpringBank springs_;  // those that pull now: what most frames are made of
  double now_ = 0;
  double nextSwitch_ = 0;  // the first time at which a drive that waits sets out
};

}  // namespace sweepface
