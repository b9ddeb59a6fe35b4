#include "sweepface/live_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace sweepface {
namespace {

struct Name {
  Drive::Kind kind;
  std::string_view text;
};

constexpr std::array kNames{Name{Drive::Kind::cut, "cut"},
                            Name{Drive::Kind::newton, "newton"},
                            Name{Drive::Kind::linearForce, "linear-force"},
                            Name{Drive::Kind::accelerateBrake, "accelerate-brake"},
                            Name{Drive::Kind::spring, "spring"},
                            Name{Drive::Kind::bounce, "bounce"}};

constexpr double kNever = std::numeric_limits<double>::infinity();

Result<void> checkIndex(std::size_t weight, std::size_t count) {
  if (weight < count) return {};
  return failCall("There is no weight ", weight, "; there are ", count, ".");
}

}  // namespace

Result<Drive> driveFromName(std::string_view name) {
  std::string names;
  for (const Name& n : kNames) {
    if (name == n.text) return Drive{.kind = n.kind, .spring = {}};
    if (!names.empty()) names += ", ";
    names += n.text;
  }
  return failCall("There is no way to move called \"", name, "\"; there are ", names, ".");
}

std::string_view nameOf(Drive::Kind kind) noexcept {
  const auto found = std::ranges::find(kNames, kind, &Name::kind);
  return found == kNames.end() ? "" : found->text;
}

Result<Trajectory> trajectoryOf(const Drive& drive, Start start, double goal) {
  switch (drive.kind) {
    case Drive::Kind::newton:
      return Trajectory::constantForce(start, goal, drive.seconds);
    case Drive::Kind::linearForce:
      return Trajectory::linearForce(start, goal, drive.seconds);
    case Drive::Kind::accelerateBrake:
      return Trajectory::twoForces(start, goal, drive.seconds, drive.turn);
    case Drive::Kind::spring:
      return Trajectory::spring(start, goal, drive.spring);
    case Drive::Kind::bounce:
      return Trajectory::bounce(start, goal, drive.seconds, drive.restitution);
    case Drive::Kind::cut:
      break;
  }
  if (!std::isfinite(goal)) return failCall("A goal must be a finite number.");
  return Trajectory(goal);
}

Kinematics MotionState::Coordinate::at(double time) const noexcept {
  return time < switchAt ? now.at(time - began) : next.at(time - switchAt);
}

Result<MotionState> MotionState::make(std::span<const double> weights) {
  MotionState state;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (!std::isfinite(weights[k]))
      return failCall("Weight ", k, " of the motion is not a finite number.");
    state.coordinates_.push_back({Trajectory(weights[k]), Trajectory(weights[k]), 0, 0});
  }
  state.springs_ = SpringBank(weights.size());
  state.nextSwitch_ = kNever;
  return state;
}

void MotionState::advance(double seconds) noexcept {
  const double before = now_;
  if (seconds > 0 && seconds <= kMostSeconds) now_ += seconds;
  if (now_ < nextSwitch_) return;
  nextSwitch_ = kNever;
  for (std::size_t k = 0; k < size(); ++k)
    if (coordinates_[k].switchAt > before) notePull(k);
}

void MotionState::notePull(std::size_t weight) noexcept {
  const Coordinate& coordinate = coordinates_[weight];
  const bool waits = now_ < coordinate.switchAt;
  if (waits) nextSwitch_ = std::min(nextSwitch_, coordinate.switchAt);
  const Trajectory& trajectory = waits ? coordinate.now : coordinate.next;
  const path::Swing* const swing = trajectory.swing();
  if (swing)
    springs_.pull(weight, *swing, waits ? coordinate.began : coordinate.switchAt);
  else
    springs_.release(weight);
}

Kinematics MotionState::at(std::size_t weight, double time) const noexcept {
  return springs_.pulls(weight) ? springs_.at(weight, time) : coordinates_[weight].at(time);
}

Result<Trajectory> MotionState::prepare(std::size_t weight, double goal, const Drive& drive) const {
  if (auto ok = checkIndex(weight, size()); !ok) return std::unexpected(ok.error());
  if (!(std::isfinite(drive.delay) && drive.delay >= 0))
    return failCall("The delay of a motion must be at least 0 seconds.");
  // Its state when the drive sets out.
  const Coordinate& coordinate = coordinates_[weight];
  const double start = now_ + drive.delay;
  const Kinematics from = now_ < coordinate.switchAt && !springs_.pulls(weight)
                              ? coordinate.now.at(start - coordinate.began)
                              : at(weight, start);
  return trajectoryOf(drive, {from.position, from.velocity}, goal);
}

void MotionState::take(std::size_t weight, const Trajectory& next, double delay) noexcept {
  // A drive that still waits is replaced; one that has set out goes on until the switch.
  Coordinate& coordinate = coordinates_[weight];
  if (now_ >= coordinate.switchAt) {
    coordinate.now = coordinate.next;
    coordinate.began = coordinate.switchAt;
  }
  coordinate.next = next;
  coordinate.switchAt = now_ + delay;
  notePull(weight);
}

Result<void> MotionState::check(std::size_t weight, double goal, const Drive& drive) const {
  if (const auto next = prepare(weight, goal, drive); !next) return std::unexpected(next.error());
  return {};
}

Result<void> MotionState::moveTo(std::size_t weight, double goal, const Drive& drive) {
  const Result<Trajectory> next = prepare(weight, goal, drive);
  if (!next) return std::unexpected(next.error());
  take(weight, *next, drive.delay);
  return {};
}

Result<void> MotionState::moveTo(std::span<const double> goals, const Drive& drive) {
  if (goals.size() != size())
    return failCall("There are ", goals.size(), " goals for ", size(), " weights; give one each.");
  // All are checked before the first sets out, so that an error leaves everything as it was.
  for (std::size_t k = 0; k < size(); ++k)
    if (auto ok = check(k, goals[k], drive); !ok) return ok;
  for (std::size_t k = 0; k < size(); ++k) take(k, *prepare(k, goals[k], drive), drive.delay);
  return {};
}

Result<Trajectory> MotionState::pushed(std::size_t weight, double velocityChange,
                                       double drag) const {
  if (auto ok = checkIndex(weight, size()); !ok) return std::unexpected(ok.error());
  const Kinematics from = sample(weight);
  return Trajectory::impulse({from.position, from.velocity}, velocityChange, drag);
}

Result<void> MotionState::push(std::size_t weight, double velocityChange, double drag) {
  const auto next = pushed(weight, velocityChange, drag);
  if (!next) return std::unexpected(next.error());
  take(weight, *next, 0);
  return {};
}

Kinematics MotionState::sample(std::size_t weight) const noexcept {
  return weight < size() ? at(weight, now_) : Kinematics{};
}

void MotionState::positions(std::span<double> out) const noexcept {
  const std::size_t count = std::min(size(), out.size());
  springs_.positions(now_, out);
  if (springs_.pullsAll()) return;
  for (std::size_t k = 0; k < count; ++k)
    if (!springs_.pulls(k)) out[k] = coordinates_[k].at(now_).position;
}

void MotionState::velocities(std::span<double> out) const noexcept {
  const std::size_t count = std::min(size(), out.size());
  springs_.velocities(now_, out);
  if (springs_.pullsAll()) return;
  for (std::size_t k = 0; k < count; ++k)
    if (!springs_.pulls(k)) out[k] = coordinates_[k].at(now_).velocity;
}

bool MotionState::moves(double tolerance) const noexcept {
  return std::ranges::any_of(coordinates_, [&](const Coordinate& c) {
    return now_ < c.switchAt || c.next.moves(now_ - c.switchAt, tolerance);
  });
}

}  // namespace sweepface
