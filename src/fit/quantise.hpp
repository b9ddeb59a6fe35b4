#pragma once

#include <functional>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// What packing keeps to, and what it aims at.
struct PackAims {
  double tolerance = 0;  ///< every source vertex of every pose stays within it
  double angle = 0;      ///< tangents turn by about that where it is cheap: degrees, rms
  double stepShare = 1;  ///< its steps, of those that the tolerance alone asks for
};

/// Moves the vectors of a fitted rig to what a file can hold in few bytes: coefficients that the
/// tolerance does not need become zero, and the others as small as it allows. The rig must be
/// nearer to the source than that, to leave room. `proceed` hears how far it is and answers whether
/// to go on; it is called from several threads.
Result<void> quantise(Rig& rig, const MeshRig& source, const PackAims& aims,
                      const std::function<bool(double done)>& proceed);

}  // namespace sweepface
