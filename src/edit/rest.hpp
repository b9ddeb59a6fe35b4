#pragma once

#include "sweepface/rig.hpp"

namespace sweepface::edit {

/// To be called before the neutral changes: what targets are counted from stays.
inline void keepRest(Rig& rig) {
  if (rig.packing.neutralStep > 0 && rig.packing.rest.empty()) rig.packing.rest = rig.neutral;
}

}  // namespace sweepface::edit
