#pragma once

#include "sweepface/live_motion.hpp"

#include "values.hpp"

namespace sweepface::python {

/// A drive by its name, and what else was told of it.
Drive driveFrom(const std::string& name, const py::kwargs& told);

/// Refuses times that cannot pass at once.
void checkPassing(double seconds);

}  // namespace sweepface::python
