#pragma once

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// The angle between the surface's normal and the source's vertex normal: the root of its mean
/// square over all vertices of the neutral and of every target, in degrees.
double normalRms(const Rig& rig, const MeshRig& source);

}  // namespace sweepface
