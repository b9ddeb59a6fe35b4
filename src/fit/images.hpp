#pragma once

#include <string>

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"

namespace sweepface {

/// Replaces "Left" by "Right", "_L" by "_R" and vice versa where a name first says a side; returns
/// a name that says none unchanged. Applied twice, it gives the name itself.
std::string otherSide(std::string name);

/// Chooses for each pose the mirror image that leaves the fewest bits to store: none, its own, or
/// that of the target whose name says the other side. Names come in pairs, so a pose that is
/// compared with another one is never itself what a third is compared with.
void chooseImages(const Rig& rig, const codec::Lattice& lattice, Packing& packing);

}  // namespace sweepface
