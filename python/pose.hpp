#pragma once

#include <memory>
#include <vector>

#include "values.hpp"

namespace sweepface::python {

/// A rig under some weights, for the reference evaluation in double precision.
struct Pose {
  std::shared_ptr<const Rig> rig;
  Weights weights;            // of the first region, with which vertices of no face go
  std::vector<Vec3> vectors;  // settled

  /// In regions, if they are not None, as RegionalWeights::from() takes their weights.
  Pose(std::shared_ptr<const Rig> of, const py::object& given, const py::object& regions);
};

}  // namespace sweepface::python
