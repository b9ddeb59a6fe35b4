#pragma once

#include "sweepface/gltf.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/builder.hpp"

namespace sweepface::gltf {

/// Puts everything that the scene shows under a node "head" at the pivot, except skinned meshes,
/// which their joints move, and adds its rotation to an animation.
Result<void> addHeadTrack(Document& document, const HeadTrack& track, double tolerance,
                          Json& animation, Builder& builder);

}  // namespace sweepface::gltf
