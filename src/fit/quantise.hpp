#pragma once

#include <functional>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

#include "fit/pack_goals.hpp"

namespace sweepface {

/// What packing guarantees, and what it aims at.
struct PackAims {
  double tolerance = 0;  ///< every vertex of every pose stays within it of its goal
  double angle = 0;      ///< tangents turn by about this where that is cheap: degrees, RMS
  double stepShare = 1;  ///< size of its steps, relative to those that suit the tolerance alone
};

/// Moves the vectors of a rig to values that a file can hold in few bytes: coefficients that the
/// tolerance does not need become zero, and the others as small as it allows. The rig must be
/// nearer to its goals than the tolerance, to leave room. `proceed` receives the progress and
/// returns whether to go on; it is called from several threads.
Result<void> quantise(Rig& rig, const MeshRig& source, PackGoals goals, const PackAims& aims,
                      const std::function<bool(double done)>& proceed);

}  // namespace sweepface
