#pragma once

#include "values.hpp"

namespace sweepface::python {

// Each adds its classes and functions to the module.
void addEquation(py::module_& m);
void addMeshes(py::module_& m);
void addPose(py::module_& m);
void addRig(py::module_& m);
void addConversion(py::module_& m);
void addMeasurement(py::module_& m);
void addFace(py::module_& m);
void addTrajectory(py::module_& m);
void addMotion(py::module_& m);
void addLiveMotion(py::module_& m);
void addRegionalMotion(py::module_& m);
void addClip(py::module_& m);
void addClipsOfRigs(py::module_& m);  // what is known of a clip with a rig
void addRegions(py::module_& m);
void addRegionsOfRigs(py::module_& m);  // how a rig is divided into them
void addTimeline(py::module_& m);
void addHead(py::module_& m);
void addPicture(py::module_& m);

}  // namespace sweepface::python
