#pragma once

#include "sweepface/drawing.hpp"

namespace sweepface::drawing {

/// The names and units of a drawing, for the rig that was built of it. Names that are what a thing
/// without one is called anyway are not kept. An error if another thing goes by a name.
Result<void> nameThings(const Drawing& drawing, Rig& rig);

}  // namespace sweepface::drawing
