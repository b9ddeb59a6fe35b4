#pragma once

#include <string>

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"

namespace sweepface {

/// "Left" for "Right", "_L" for "_R", and the other way round, where a name first says a side; the
/// same name if it says none. The other side of the other side is the name itself.
std::string otherSide(std::string name);

/// For each pose the mirror image that leaves least to be told: none, its own, or that of the
/// target whose name says the other side. Names go by twos, so what is compared with another pose
/// is never itself what a third is compared with.
void chooseImages(const Rig& rig, const codec::Lattice& lattice, Packing& packing);

}  // namespace sweepface
