#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

namespace sweepface {

/// How a motion progresses over time: which force moves it.
enum class TimeLaw {
  linear,           ///< no force: constant speed
  newton,           ///< constant force from rest: s²
  brake,            ///< constant force to rest: 2s − s²
  accelerateBrake,  ///< constant force to the middle, then its opposite: from rest to rest
  linearForce,      ///< a force linear in time: 3s² − 2s³, from rest to rest
};

/// Every law, in the order of the enum.
inline constexpr std::array timeLaws{TimeLaw::linear, TimeLaw::newton, TimeLaw::brake,
                                     TimeLaw::accelerateBrake, TimeLaw::linearForce};

/// "linear", "newton", "brake", "accelerate-brake" or "linear-force"; the error lists them.
Result<TimeLaw> timeLawFromName(std::string_view name);
std::string_view nameOf(TimeLaw law) noexcept;

/// Where a motion of unit length and unit duration stands.
struct Progress {
  double position = 0;      ///< fraction of the way, in [0, 1]
  double velocity = 0;      ///< its first derivative in s
  double acceleration = 0;  ///< its second derivative in s
};

/// The law at `s`, the fraction of the time. Before 0 (or where `s` is not a number) it rests at 0,
/// after 1 it rests at 1; at 0 and at 1 the derivatives are those from inside. The force of
/// accelerateBrake turns at 1/2, which counts as braking.
Progress progress(TimeLaw law, double s) noexcept;

/// One weight at one time.
struct MotionSample {
  double position = 0;  ///< the weight
  double velocity = 0;  ///< per second
  double force = 0;     ///< mass × acceleration, the latter per second²
};

/// A motion of K weights from one set to another. Blending is linear in the weights, so every
/// vertex of the blended face moves by the same law. Evaluating allocates nothing; at times outside
/// [0, seconds] the weights are at rest at the nearer end.
class Motion {
 public:
  /// Refuses sets of different sizes, values that are not finite, a duration or a mass that is not
  /// positive, and motions so fast that a speed or a force overflows.
  static Result<Motion> make(std::span<const double> from, std::span<const double> to, TimeLaw law,
                             double seconds, double mass = 1);

  std::size_t size() const noexcept { return from_.size(); }
  std::span<const double> from() const noexcept { return from_; }
  std::span<const double> to() const noexcept { return to_; }
  TimeLaw law() const noexcept { return law_; }
  double seconds() const noexcept { return seconds_; }
  double mass() const noexcept { return mass_; }

  /// The weights at `time`: `from` at 0 and `to` at the end, bit for bit. Like its two siblings it
  /// writes min(size(), out.size()) values.
  void at(double time, std::span<double> out) const noexcept;
  void velocities(double time, std::span<double> out) const noexcept;
  void forces(double time, std::span<double> out) const noexcept;

  /// All three for one weight, `weight` < size().
  MotionSample sample(std::size_t weight, double time) const noexcept;

 private:
  Motion() = default;
  MotionSample sampleAt(std::size_t weight, const Progress& done) const noexcept;
  void write(double MotionSample::* what, double time, std::span<double> out) const noexcept;

  std::vector<double> from_, to_;  // [K]
  TimeLaw law_ = TimeLaw::linear;
  double seconds_ = 1, mass_ = 1;
};

}  // namespace sweepface
