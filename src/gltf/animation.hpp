#pragma once

#include "sweepface/gltf.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/builder.hpp"

namespace sweepface::gltf {

/// Adds the animation of the weights that the options ask for, with a channel for every node that
/// shows a mesh with targets. The keys of a motion hold its law exactly, as straight lines or
/// parabolas between them; between those of a clip are straight lines.
Result<void> addAnimation(BoundScene& scene, const GlbOptions& options, Builder& builder);

/// Shows the meshes at these weights [the rig's targets].
void setWeights(BoundScene& scene, const std::vector<double>& weights);

}  // namespace sweepface::gltf
