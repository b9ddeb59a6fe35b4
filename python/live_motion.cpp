#include "sweepface/live_motion.hpp"

#include <algorithm>

#include "bindings.hpp"
#include "drives.hpp"
#include "io/drive_numbers.hpp"

namespace sweepface::python {

Drive driveFrom(const std::string& name, const py::kwargs& told) {
  Drive drive = valueOf(driveFromName(name));
  const auto numbers = io::numbersOf(drive);
  for (const auto& [key, value] : told) {
    const auto what = py::cast<std::string>(key);
    const auto number =
        std::ranges::find(numbers, what, [](const auto& pair) { return std::string(pair.first); });
    if (number == numbers.end() || !io::takes(drive.kind, what))
      throw Failure("The drive '" + name + "' has no use for '" + what + "'; leave it out.");
    *number->second = numberFrom(value, what.c_str());
  }
  return drive;
}

void checkPassing(double seconds) {
  if (!(seconds >= 0 && seconds <= kMostSeconds))
    throw Failure("Time passes by 0 to 1e10 seconds.");
}

namespace {

using WriteState = void (MotionState::*)(std::span<double>) const noexcept;

template <WriteState write>
py::array_t<double> stateOf(const MotionState& state) {
  py::array_t<double> out(static_cast<py::ssize_t>(state.size()));
  (state.*write)({out.mutable_data(), state.size()});
  return out;
}

}  // namespace

void addLiveMotion(py::module_& m) {
  using namespace py::literals;
  py::class_<MotionState>(
      m, "LiveMotion",
      "Weights [K] that take new goals at any instant and go on from where they are, without a "
      "jump in position or velocity. Every path is a closed form of the time, so the frame rate "
      "changes nothing.")
      .def(py::init([](const py::object& given) {
             const Doubles weights = weightsOfMotion(given, "Weights");
             return valueOf(MotionState::make(numbersIn(weights, "Weights")));
           }),
           "weights"_a, "At rest there.")
      .def(
          "advance",
          [](MotionState& state, double seconds) {
            checkPassing(seconds);
            state.advance(seconds);
          },
          "seconds"_a, "Lets time pass.")
      .def(
          "move_to",
          [](MotionState& state, const py::object& goals, const std::string& drive,
             const py::kwargs& told) {
            const Doubles row = weightsOfMotion(goals, "Goals");
            valueOf(state.moveTo(numbersIn(row, "Goals"), driveFrom(drive, told)));
          },
          "goals"_a, "drive"_a = "spring",
          "Sends all weights to goals [K] by a drive: cut, newton, linear-force, accelerate-brake, "
          "spring or bounce. Its numbers are given by keywords: seconds until it arrives (0.3; not "
          "for cut and spring), turn (0.5; accelerate-brake), frequency (2) and damping (1; "
          "spring), restitution (0.4; bounce), and delay (0).")
      .def(
          "move_one",
          [](MotionState& state, const py::object& weight, double goal, const std::string& drive,
             const py::kwargs& told) {
            valueOf(state.moveTo(weightOfMotion(weight), goal, driveFrom(drive, told)));
          },
          "weight"_a, "goal"_a, "drive"_a = "spring", "The same for a single weight.")
      .def(
          "push",
          [](MotionState& state, const py::object& weight, double velocityChange, double drag) {
            valueOf(state.push(weightOfMotion(weight), velocityChange, drag));
          },
          "weight"_a, "velocity_change"_a, "drag"_a,
          "An impulse: adds to a weight's velocity, which drag, per second, takes away again.")
      .def_property_readonly("now", &MotionState::now, "Seconds since it was made.")
      .def_property_readonly("positions", &stateOf<&MotionState::positions>, "[K]")
      .def_property_readonly("velocities", &stateOf<&MotionState::velocities>, "[K], per second")
      .def("moves", &MotionState::moves, "tolerance"_a = 1e-6,
           "Whether any weight may still be further than a tolerance from where it comes to rest.");
}

}  // namespace sweepface::python
