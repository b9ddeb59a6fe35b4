#include "sweepface/trajectory.hpp"

#include "bindings.hpp"

namespace sweepface::python {
namespace {

Start startAt(double position, double velocity) { return {position, velocity}; }

Trajectory periodic(double start, double end, double seconds, double period,
                    const std::vector<std::pair<double, double>>& harmonics, double velocity) {
  std::vector<Harmonic> terms;
  for (const auto& [cosine, sine] : harmonics) terms.push_back({cosine, sine});
  return valueOf(Trajectory::periodicForce(startAt(start, velocity), end, seconds, period, terms));
}

/// Positions, velocities and accelerations at times [N].
py::tuple kinematicsAt(const Trajectory& path, const Doubles& times) {
  const auto rows = rowsAt(times, 3, [&](double time, std::span<double> row) {
    const Kinematics k = path.at(time);
    row[0] = k.position, row[1] = k.velocity, row[2] = k.acceleration;
  });
  return py::tuple(rows.attr("T"));
}

}  // namespace

void addTrajectory(py::module_& m) {
  using namespace py::literals;
  py::class_<Trajectory>(
      m, "Trajectory",
      "The path of one weight under a force, in closed form. Before time 0 it is at its start; a "
      "path that arrives rests at its goal from then on. Times are in seconds.")
      .def_static(
          "by_law",
          [](const std::string& law, double start, double end, double seconds) {
            return valueOf(Trajectory::byLaw(valueOf(timeLawFromName(law)), start, end, seconds));
          },
          "law"_a, "start"_a, "end"_a, "seconds"_a, "A law (see laws) from rest.")
      .def_static(
          "constant_force",
          [](double start, double end, double seconds, double velocity) {
            return valueOf(Trajectory::constantForce(startAt(start, velocity), end, seconds));
          },
          "start"_a, "end"_a, "seconds"_a, "velocity"_a = 0,
          "Newton's second law from any velocity: x'' = 2 (end - start - velocity T) / T^2 with T "
          "= seconds.")
      .def_static(
          "linear_force",
          [](double start, double end, double seconds, double velocity, double endVelocity) {
            return valueOf(
                Trajectory::linearForce(startAt(start, velocity), end, seconds, endVelocity));
          },
          "start"_a, "end"_a, "seconds"_a, "velocity"_a = 0, "end_velocity"_a = 0,
          "A force that is linear in time, from any velocity to any velocity.")
      .def_static(
          "two_forces",
          [](double start, double end, double seconds, double velocity, double turn) {
            return valueOf(Trajectory::twoForces(startAt(start, velocity), end, seconds, turn));
          },
          "start"_a, "end"_a, "seconds"_a, "velocity"_a = 0, "turn"_a = 0.5,
          "Two constant forces, the second from turn * seconds on: from any velocity to rest.")
      .def_static(
          "spring",
          [](double start, double end, double frequency, double damping, double velocity) {
            return valueOf(Trajectory::spring(startAt(start, velocity), end, {frequency, damping}));
          },
          "start"_a, "end"_a, "frequency"_a = Spring{}.frequency, "damping"_a = Spring{}.damping,
          "velocity"_a = 0,
          "A damped spring: frequency in hertz; damping below 1 overshoots, 1 is the fastest "
          "without overshoot.")
      .def_static(
          "bounce",
          [](double start, double end, double seconds, double restitution, double velocity) {
            return valueOf(Trajectory::bounce(startAt(start, velocity), end, seconds, restitution));
          },
          "start"_a, "end"_a, "seconds"_a, "restitution"_a = 0.4, "velocity"_a = 0,
          "Falls to the goal and bounces off it, each time keeping a share of its speed.")
      .def_static(
          "impulse",
          [](double start, double velocityChange, double drag, double velocity) {
            return valueOf(Trajectory::impulse(startAt(start, velocity), velocityChange, drag));
          },
          "start"_a, "velocity_change"_a, "drag"_a, "velocity"_a = 0,
          "Adds to the velocity at once; drag, per second, takes the speed away again.")
      .def_static("periodic_force", &periodic, "start"_a, "end"_a, "seconds"_a, "period"_a,
                  "harmonics"_a, "velocity"_a = 0,
                  "A periodic force of (cosine, sine) terms, the k-th of k / period, and the "
                  "constant force that makes it arrive.")
      .def("__call__", &kinematicsAt, "times"_a,
           "Positions, velocities and accelerations at times [N]: a tuple of three arrays [N].")
      .def("moves", &Trajectory::moves, "time"_a, "tolerance"_a = 1e-6,
           "Whether it may be further than a tolerance from where it comes to rest, then or "
           "later.");
}

}  // namespace sweepface::python
