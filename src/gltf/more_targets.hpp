#pragma once

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Gives the meshes of the parts more morph targets, behind those that they have: no data yet,
/// weights of 0, and as many more zeros in animations of their weights.
Result<void> addTargets(Document& document, const Parts& parts,
                        const std::vector<std::string>& names);

}  // namespace sweepface::gltf
