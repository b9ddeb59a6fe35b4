#include <exception>

#include "bindings.hpp"

namespace sweepface::python {
namespace {

void addErrors(py::module_& m) {
  py::exception<Failure> type(m, "Error", PyExc_ValueError);
  type.doc() = "What was asked for cannot be done; the message says why and what to do.";
  static py::handle error;
  error = type.release();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Failure& failure) {
      PyErr_SetObject(error.ptr(), textOf(failure.what()).ptr());
    } catch (const py::cast_error&) {
      PyErr_SetString(PyExc_TypeError, "An argument has another type than it should.");
    }
  });
}

}  // namespace
}  // namespace sweepface::python

PYBIND11_MODULE(_core, m) {
  using namespace sweepface::python;
  m.attr("__name__") = "sweepface";  // of which its classes and functions say that they are
  m.attr("__version__") = SWEEPFACE_VERSION;
  addErrors(m);
  addEquation(m);
  addMeshes(m);
  addTrajectory(m);
  addMotion(m);
  addLiveMotion(m);
  addRegions(m);
  addRegionalMotion(m);
  addPose(m);
  addClip(m);
  addRig(m);
  addClipsOfRigs(m);
  addRegionsOfRigs(m);
  addTimeline(m);
  addHead(m);
  addConversion(m);
  addMeasurement(m);
  addFace(m);
  addPicture(m);
}
