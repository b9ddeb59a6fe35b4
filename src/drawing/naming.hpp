#pragma once

#include "sweepface/drawing.hpp"

namespace sweepface::drawing {

/// Gives a rig the names and units of the drawing that it was built from. Names that equal the
/// default name of their thing are not kept. Fails if a name is the default name of another thing
/// that has none.
Result<void> nameThings(const Drawing& drawing, Rig& rig);

}  // namespace sweepface::drawing
