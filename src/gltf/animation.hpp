#pragma once

#include "sweepface/gltf.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/builder.hpp"

namespace sweepface::gltf {

/// Adds the animation of the weights that the options ask for, with a channel for every node that
/// shows a mesh with targets of the rig. The keys of a motion hold its law exactly, with straight
/// lines or parabolas between them; those of a clip are joined by straight lines, or by cubic
/// splines within the key tolerance.
Result<void> addAnimation(BoundScene& scene, const GlbOptions& options, Builder& builder);

/// Sets the weights at which the meshes are shown [the rig's targets].
void setWeights(BoundScene& scene, const std::vector<double>& weights);

}  // namespace sweepface::gltf
