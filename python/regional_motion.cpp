#include "sweepface/regional_motion.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bindings.hpp"
#include "drives.hpp"
#include "regions.hpp"

namespace sweepface::python {
namespace {

/// A motion whose regions have names.
struct NamedMotion {
  std::vector<std::string> names;
  RegionalMotion motion;

  std::size_t numberOf(const py::object& region) const {
    if (!py::isinstance<py::str>(region))
      return as<std::size_t>(region, "A region", "a name or a number");
    const auto name = textFrom(region, "A region");
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw Failure(
          fmt::format("There is no region '{}'; there are {}.", name, fmt::join(names, ", ")));
    return static_cast<std::size_t>(found - names.begin());
  }
};

NamedMotion motionOf(const py::object& given, const py::object& listed) {
  const Doubles weights = weightsOfMotion(given, "Weights");
  const std::vector<Region> regions = dividedRegionsIn(listed);
  return {namesOf(regions),
          valueOf(RegionalMotion::make(numbersIn(weights, "Weights"), mattersOf(regions)))};
}

using WriteRegions = void (RegionalMotion::*)(std::span<double>) const noexcept;

template <WriteRegions write>
py::array_t<double> regionalStateOf(const NamedMotion& named) {
  const RegionalMotion& motion = named.motion;
  py::array_t<double> out({motion.regionCount(), motion.size()});
  (motion.*write)({out.mutable_data(), motion.regionCount() * motion.size()});
  return out;
}

}  // namespace

void addRegionalMotion(py::module_& m) {
  using namespace py::literals;
  py::class_<NamedMotion>(m, "RegionalMotion",
                          "A LiveMotion in every region of a face: what moves a weight moves it in "
                          "all regions, in each by its own mass, stiffness and delay.")
      .def(py::init(&motionOf), "weights"_a, "regions"_a,
           "At rest at weights [K] in all regions, which are as Rig.divide returns them.")
      .def_readonly("regions", &NamedMotion::names, "Their names.")
      .def(
          "advance",
          [](NamedMotion& named, double seconds) {
            checkPassing(seconds);
            named.motion.advance(seconds);
          },
          "seconds"_a, "Lets time pass.")
      .def(
          "move_to",
          [](NamedMotion& named, const py::object& goals, const std::string& drive,
             const py::kwargs& told) {
            const Doubles row = weightsOfMotion(goals, "Goals");
            valueOf(named.motion.moveTo(numbersIn(row, "Goals"), driveFrom(drive, told)));
          },
          "goals"_a, "drive"_a = "spring",
          "Sends all weights to goals [K] by a drive with its numbers, as LiveMotion.move_to does.")
      .def(
          "move_one",
          [](NamedMotion& named, const py::object& weight, double goal, const std::string& drive,
             const py::kwargs& told) {
            valueOf(named.motion.moveTo(weightOfMotion(weight), goal, driveFrom(drive, told)));
          },
          "weight"_a, "goal"_a, "drive"_a = "spring", "The same for a single weight.")
      .def(
          "move_in",
          [](NamedMotion& named, const py::object& region, const py::object& weight, double goal,
             const std::string& drive, const py::kwargs& told) {
            const std::size_t number = named.numberOf(region);
            valueOf(
                named.motion.moveTo(number, weightOfMotion(weight), goal, driveFrom(drive, told)));
          },
          "region"_a, "weight"_a, "goal"_a, "drive"_a = "spring",
          "The same in one region alone, by its name or number.")
      .def(
          "put_in",
          [](NamedMotion& named, const py::object& region, const py::object& weight, double value) {
            valueOf(named.motion.put(named.numberOf(region), weightOfMotion(weight), value));
          },
          "region"_a, "weight"_a, "value"_a,
          "Puts a weight there at once in one region, whatever its delay.")
      .def(
          "push",
          [](NamedMotion& named, const py::object& weight, double velocityChange, double drag) {
            valueOf(named.motion.push(weightOfMotion(weight), velocityChange, drag));
          },
          "weight"_a, "velocity_change"_a, "drag"_a,
          "An impulse, which a heavy region feels less, and a late one at once.")
      .def_property_readonly("positions", &regionalStateOf<&RegionalMotion::positions>, "[R, K]")
      .def_property_readonly("velocities", &regionalStateOf<&RegionalMotion::velocities>,
                             "[R, K], per second")
      .def(
          "moves",
          [](const NamedMotion& named, double tolerance) { return named.motion.moves(tolerance); },
          "tolerance"_a = 1e-6,
          "Whether any weight may still be further than a tolerance from where it comes to rest.");
}

}  // namespace sweepface::python
