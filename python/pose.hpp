#pragma once

#include <memory>
#include <vector>

#include "values.hpp"

namespace sweepface::python {

/// A rig under some weights, for the reference evaluation in double precision.
struct Pose {
  std::shared_ptr<const Rig> rig;
  Weights weights;
  std::vector<Vec3> vectors;  // settled

  Pose(std::shared_ptr<const Rig> of, const py::object& given)
      : rig(std::move(of)), weights(weightsFrom(*rig, given)), vectors(blend(*rig, weights)) {}
};

}  // namespace sweepface::python
