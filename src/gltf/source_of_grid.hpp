#pragma once

#include "sweepface/rig.hpp"

namespace sweepface::gltf {

/// A source for a rig that lacks one: vertices and faces of the surface at level 1.
SourceMesh sourceOfGrid(const Rig& rig);

}  // namespace sweepface::gltf
