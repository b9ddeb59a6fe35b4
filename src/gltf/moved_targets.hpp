#pragma once

#include <optional>
#include <vector>

#include "gltf/bound_scene.hpp"

namespace sweepface::gltf {

/// [meshes][targets] the rig's target that each moves with, or -1. Those of the face's meshes, and
/// of other meshes those that are given the same names, so that levels of detail and what else
/// morphs with a face stay together.
std::vector<std::vector<Index>> movedTargets(const BoundScene& scene);

/// [targets] the weights that a mesh or a node has, if there is one for each target.
std::optional<std::vector<double>> weightsOf(const Json& holder, std::size_t targets);

}  // namespace sweepface::gltf
