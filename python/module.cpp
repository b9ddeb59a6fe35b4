#include "bindings.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace sweepface::python;
  m.attr("__name__") = "sweepface";  // of which its classes and functions say that they are
  m.attr("__version__") = SWEEPFACE_VERSION;
  py::register_exception<Failure>(m, "Error", PyExc_ValueError).doc() =
      "What was asked for cannot be done; the message says why and what to do.";
  addEquation(m);
  addMeshes(m);
  addTrajectory(m);
  addMotion(m);
  addLiveMotion(m);
  addPose(m);
  addClip(m);
  addRig(m);
  addClipsOfRigs(m);
  addConversion(m);
  addMeasurement(m);
  addFace(m);
  addPicture(m);
}
