#pragma once

#include <functional>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Moves the vectors of a fitted rig to what a file can hold in few bytes, every source vertex of
/// every pose staying within the tolerance: coefficients that the tolerance does not need become
/// zero, and the others as small as it allows. The fit must have left room. Tangents turn by about
/// `angle` (degrees, root mean square) where that is cheap. `proceed` hears how far it is and
/// answers whether to go on; it is called from several threads.
Result<void> quantise(Rig& rig, const MeshRig& source, double tolerance, double angle,
                      const std::function<bool(double done)>& proceed);

}  // namespace sweepface
