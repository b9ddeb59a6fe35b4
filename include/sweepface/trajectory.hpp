#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <variant>

#include "sweepface/motion.hpp"
#include "sweepface/result.hpp"

namespace sweepface {

/// The state of a coordinate. Seconds are the unit of time; acceleration is the force on a unit
/// mass.
struct Kinematics {
  double position = 0, velocity = 0, acceleration = 0;
};

/// Where a trajectory begins.
struct Start {
  double position = 0, velocity = 0;
};

/// A spring with a damper, hung on its goal: x″ = −2ζω x′ − ω² (x − goal), ω = 2π · frequency.
struct Spring {
  double frequency = 2;  ///< oscillations a second without the damper
  double damping = 1;    ///< ζ: < 1 overshoots, 1 is the fastest without overshoot, > 1 creeps

  /// The spring whose swings halve every `seconds`.
  static Spring withHalfLife(double seconds, double damping);
};

/// One term of a periodic force, per unit mass.
struct Harmonic {
  double cosine = 0, sine = 0;
};

/// The most harmonics that a periodic force may have.
inline constexpr std::size_t kMostHarmonics = 8;

/// The closed forms behind a Trajectory.
namespace path {

struct Cubic {
  double x = 0, v = 0, a = 0, jerk = 0;
  Kinematics at(double t) const noexcept;
};
// One or two cubics, then rest.
struct Pieces {
  Cubic first, second;
  double turn, end, goal;
  Kinematics at(double t) const noexcept;
  bool moves(double t, double tolerance) const noexcept;
};
struct Swing {
  double goal, x, v, sigma, omega;
  Kinematics at(double t) const noexcept;
  bool moves(double t, double tolerance) const noexcept;
  // What becomes of position and velocity at the start: the same for all springs of one kind.
  struct Decay {
    double c, s;
  };
  Decay decay(double t) const noexcept;
  // What a distance from the goal and a velocity have become by then.
  Kinematics wayAfter(const Decay& d, const Start& y) const noexcept {
    const double pull = omega * omega;
    const double way = d.c * y.position + d.s * (y.velocity + sigma * y.position);
    const double speed = d.c * y.velocity - d.s * (sigma * y.velocity + pull * y.position);
    return {way, speed, -2 * sigma * speed - pull * way};
  }
};
struct Bounces {
  Cubic fall;
  double end, goal, speed, restitution;
  Kinematics at(double t) const noexcept;
  bool moves(double t, double tolerance) const noexcept;
};
struct Coasting {
  double x, v, drag;
  Kinematics at(double t) const noexcept;
  bool moves(double t, double tolerance) const noexcept;
};
struct Driven {
  Cubic mean;
  double end, goal, omega;
  std::size_t count;
  std::array<Harmonic, kMostHarmonics> harmonics;
  Kinematics at(double t) const noexcept;
  bool moves(double t, double tolerance) const noexcept;
  Kinematics periodic(double t) const noexcept;
};

}  // namespace path

/// The path of one coordinate under a force, in closed form. It is a small value: copy it freely,
/// and evaluate it at any time and as often as you like, without allocating or changing it. Before
/// time 0 it is at its start; a path that arrives rests at its goal from then on.
///
/// Every maker refuses numbers that are not finite and durations that are not greater than 0.
class Trajectory {
 public:
  /// At rest for ever.
  explicit Trajectory(double position = 0);

  /// A law of motion.hpp from rest; if it has speed at an end, the velocity jumps there.
  static Result<Trajectory> byLaw(TimeLaw law, double from, double to, double seconds);
  /// A constant force that arrives after `seconds`, from any velocity; x″ = 2 (Δ − v₀T) / T².
  static Result<Trajectory> constantForce(Start start, double to, double seconds);
  /// A force that is linear in time: from any velocity to any velocity, by default to rest.
  static Result<Trajectory> linearForce(Start start, double to, double seconds,
                                        double endVelocity = 0);
  /// Two constant forces, the second from `turn` · seconds on: from any velocity to rest.
  static Result<Trajectory> twoForces(Start start, double to, double seconds, double turn = 0.5);
  /// Swings or creeps into the goal; never arrives exactly.
  static Result<Trajectory> spring(Start start, double to, Spring spring);
  /// Falls to the goal by a constant force and bounces off it, each time keeping the share
  /// `restitution`, in [0, 1 - 1e-9], of its speed.
  static Result<Trajectory> bounce(Start start, double to, double seconds, double restitution);
  /// An impulse: adds `velocityChange` at once; drag (per second, ≥ 0) takes the speed away again.
  static Result<Trajectory> impulse(Start start, double velocityChange, double drag);
  /// A periodic force of at most kMostHarmonics harmonics of 1 / `period`, plus the constant force
  /// that makes it arrive after `seconds`.
  static Result<Trajectory> periodicForce(Start start, double to, double seconds, double period,
                                          std::span<const Harmonic> harmonics);

  Kinematics at(double time) const noexcept;
  /// Whether it may be further than `tolerance` from where it comes to rest, at `time` or later. A
  /// path that arrives moves until it has arrived or bounced for the last time; a spring, until its
  /// energy reaches no further.
  bool moves(double time, double tolerance) const noexcept;

  /// Null unless a spring pulls.
  const path::Swing* swing() const noexcept { return std::get_if<path::Swing>(&path_); }

 private:
  using Path = std::variant<path::Pieces, path::Swing, path::Bounces, path::Coasting, path::Driven>;

  explicit Trajectory(const Path& path) : path_(path) {}
  static Result<Trajectory> pieces(const path::Cubic& first, double end, double goal);

  Path path_;
};

}  // namespace sweepface
