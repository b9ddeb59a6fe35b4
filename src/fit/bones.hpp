#pragma once

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"

namespace sweepface {

/// Finds what targets move as wholes, to within half of the tolerance, and puts into the packing
/// what hangs on which bone and how targets carry it. `neutral` [S] is what the file will hold.
void findBones(const Rig& rig, const codec::Lattice& lattice, std::span<const Vec3> neutral,
               double tolerance, Packing& packing);

}  // namespace sweepface
