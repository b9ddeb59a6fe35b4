#pragma once

#include "sweepface/rig.hpp"

namespace sweepface::edit {

/// Call this before the neutral changes. It keeps the neutral that the coding of targets is based
/// on.
inline void keepRest(Rig& rig) {
  if (rig.packing.neutralStep > 0 && rig.packing.rest.empty()) rig.packing.rest = rig.neutral;
}

}  // namespace sweepface::edit
