#include "sweepface/motion.hpp"

#include "bindings.hpp"

namespace sweepface::python {
namespace {

py::tuple lawNames() {
  py::tuple names(timeLaws.size());
  for (std::size_t k = 0; k < timeLaws.size(); ++k) names[k] = py::str(nameOf(timeLaws[k]));
  return names;
}

using Write = void (Motion::*)(double, std::span<double>) const noexcept;

template <Write write>
py::array_t<double> motionAt(const Motion& motion, const Doubles& times) {
  return rowsAt(times, motion.size(),
                [&](double time, std::span<double> row) { (motion.*write)(time, row); });
}

}  // namespace

void addMotion(py::module_& m) {
  using namespace py::literals;
  m.attr("laws") = lawNames();
  py::class_<Motion>(m, "Motion",
                     "Weights [K] that move from one set to another by a law; at times outside [0, "
                     "seconds] they rest at the nearer end.")
      .def(py::init([](const py::object& from, const py::object& to, const std::string& law,
                       double seconds, double mass) {
             const Doubles start = weightsOfMotion(from, "start"), end = weightsOfMotion(to, "end");
             return valueOf(Motion::make(numbersIn(start, "start"), numbersIn(end, "end"),
                                         valueOf(timeLawFromName(law)), seconds, mass));
           }),
           "start"_a, "end"_a, "law"_a = "newton", "seconds"_a = 1, "mass"_a = 1,
           "From start [K] to end [K]; the law is one of laws.")
      .def_property_readonly("seconds", &Motion::seconds)
      .def("positions", &motionAt<&Motion::at>, "times"_a, "The weights at times [N]: [N, K].")
      .def("velocities", &motionAt<&Motion::velocities>, "times"_a, "Per second: [N, K].")
      .def("forces", &motionAt<&Motion::forces>, "times"_a,
           "Mass times acceleration, the latter per second^2: [N, K].");
}

}  // namespace sweepface::python
