#pragma once

#include "sweepface/clip.hpp"

#include "values.hpp"

namespace sweepface::python {

/// The clip with the rig's targets as names, in their order; warns of what may surprise.
Clip clipOfTargets(const Rig& rig, const Clip& clip);

}  // namespace sweepface::python
