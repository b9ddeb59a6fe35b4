#pragma once

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"

namespace sweepface {

/// Finds the parts that targets move as a whole, to within half of the tolerance, and stores in the
/// packing which vectors each bone carries and how targets move the bones. `neutral` [S] is the
/// neutral as the file will hold it.
void findBones(const Rig& rig, const codec::Lattice& lattice, std::span<const Vec3> neutral,
               double tolerance, Packing& packing);

}  // namespace sweepface
