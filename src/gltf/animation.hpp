#pragma once

#include "sweepface/motion.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/builder.hpp"

namespace sweepface::gltf {

/// Adds an animation of the weights, named after the law: with a channel for every node that shows
/// a mesh with targets. Its keys hold the law exactly, as straight lines or parabolas between them;
/// or there are `sampledKeys` > 1 with straight lines between them.
Result<void> addAnimation(BoundScene& scene, const Motion& motion, int sampledKeys,
                          Builder& builder);

/// Shows the meshes at these weights [the rig's targets].
void setWeights(BoundScene& scene, const std::vector<double>& weights);

}  // namespace sweepface::gltf
