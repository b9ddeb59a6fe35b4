#pragma once

#include "sweepface/clip.hpp"

#include "values.hpp"

namespace sweepface::python {

/// How a clip drives a rig. Warns of names that move and drive nothing, and of what else may
/// surprise; `missed` is as in RegionalClips.
ClipMatch matchWith(const Clip& clip, const Rig& rig, double missed = 0);

/// The clip with the rig's targets as names, in their order; warns of what may surprise.
Clip clipOfTargets(const Rig& rig, const Clip& clip);

}  // namespace sweepface::python
