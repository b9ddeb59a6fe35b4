#include "sweepface/motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace sweepface {
namespace {

// std::lerp is monotonic and never overshoots, but may turn a −0 at an end into +0.
double between(double from, double to, double position) {
  if (position == 0) return from;
  if (position == 1) return to;
  return std::lerp(from, to, position);
}

bool isPositive(double value) { return std::isfinite(value) && value > 0; }

// The largest |velocity| and |acceleration| of any law.
constexpr Progress kPeak{.position = 1, .velocity = 2, .acceleration = 6};

}  // namespace

std::string_view nameOf(TimeLaw law) noexcept {
  switch (law) {
    case TimeLaw::linear:
      return "linear";
    case TimeLaw::newton:
      return "newton";
    case TimeLaw::brake:
      return "brake";
    case TimeLaw::accelerateBrake:
      return "accelerate-brake";
    case TimeLaw::linearForce:
      return "linear-force";
  }
  return "";
}

Result<TimeLaw> timeLawFromName(std::string_view name) {
  std::string names;
  for (const TimeLaw law : timeLaws) {
    if (name == nameOf(law)) return law;
    if (!names.empty()) names += ", ";
    names += nameOf(law);
  }
  return failCall("There is no time law \"", name, "\"; the laws are ", names, ".");
}

Progress progress(TimeLaw law, double s) noexcept {
  if (!(s >= 0)) return {0, 0, 0};
  if (s > 1) return {1, 0, 0};
  const double left = 1 - s;
  switch (law) {
    case TimeLaw::linear:
      break;
    case TimeLaw::newton:
      return {s * s, 2 * s, 2};
    case TimeLaw::brake:
      return {1 - left * left, 2 * left, -2};
    case TimeLaw::accelerateBrake:
      if (s < 0.5) return {2 * s * s, 4 * s, 4};
      return {1 - 2 * left * left, 4 * left, -4};
    case TimeLaw::linearForce: {
      const double velocity = 6 * s * left, acceleration = 6 * (left - s);
      if (s < 0.5) return {s * s * (1 + 2 * left), velocity, acceleration};
      return {1 - left * left * (1 + 2 * s), velocity, acceleration};
    }
  }
  return {s, 1, 0};
}

Result<Motion> Motion::make(std::span<const double> from, std::span<const double> to, TimeLaw law,
                            double seconds, double mass) {
  if (from.size() != to.size()) {
    return failCall("The motion starts with ", from.size(), " weights and ends with ", to.size(),
                    "; give both ends the same weights.");
  }
  if (!isPositive(seconds)) {
    return failCall("The motion must last a finite time greater than 0 seconds.");
  }
  if (!isPositive(mass))
    return failCall("The mass of the motion must be finite and greater than 0.");

  Motion motion;
  motion.from_.assign(from.begin(), from.end());
  motion.to_.assign(to.begin(), to.end());
  motion.law_ = law;
  motion.seconds_ = seconds;
  motion.mass_ = mass;

  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!std::isfinite(from[k]) || !std::isfinite(to[k])) {
      return failCall("Weight ", k, " of the motion is not a finite number.");
    }
    const MotionSample peak = motion.sampleAt(k, kPeak);
    if (!std::isfinite(peak.velocity) || !std::isfinite(peak.force)) {
      return failCall(
          "Weight ", k,
          " of the motion moves too fast for its speed and force to be numbers; give it more "
          "seconds, less mass or a shorter way.");
    }
  }
  return motion;
}

MotionSample Motion::sampleAt(std::size_t weight, const Progress& done) const noexcept {
  const double velocity = (to_[weight] - from_[weight]) / seconds_;
  return {.position = between(from_[weight], to_[weight], done.position),
          .velocity = velocity * done.velocity,
          .force = mass_ * (velocity / seconds_ * done.acceleration)};
}

MotionSample Motion::sample(std::size_t weight, double time) const noexcept {
  return sampleAt(weight, progress(law_, time / seconds_));
}

void Motion::write(double MotionSample::* what, double time, std::span<double> out) const noexcept {
  const Progress done = progress(law_, time / seconds_);
  const std::size_t count = std::min(size(), out.size());
  for (std::size_t k = 0; k < count; ++k) out[k] = sampleAt(k, done).*what;
}

void Motion::at(double time, std::span<double> out) const noexcept {
  write(&MotionSample::position, time, out);
}

void Motion::velocities(double time, std::span<double> out) const noexcept {
  write(&MotionSample::velocity, time, out);
}

void Motion::forces(double time, std::span<double> out) const noexcept {
  write(&MotionSample::force, time, out);
}

}  // namespace sweepface
