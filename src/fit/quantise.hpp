#pragma once

#include <functional>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

#include "fit/pack_goals.hpp"

namespace sweepface {

/// What packing keeps to, and what it aims at.
struct PackAims {
  double tolerance = 0;  ///< every vertex of every pose stays within it of its goal
  double angle = 0;      ///< tangents turn by about that where it is cheap: degrees, rms
  double stepShare = 1;  ///< its steps, of those that the tolerance alone asks for
};

/// Moves the vectors of a rig to what a file can hold in few bytes: coefficients that the
/// tolerance does not need become zero, and the others as small as it allows. The rig must be
/// nearer to its goals than that, to leave room. `proceed` hears how far it is and answers whether
/// to go on; it is called from several threads.
Result<void> quantise(Rig& rig, const MeshRig& source, PackGoals goals, const PackAims& aims,
                      const std::function<bool(double done)>& proceed);

}  // namespace sweepface
