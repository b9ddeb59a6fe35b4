#pragma once

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Appends morph targets to the meshes of the parts: without data yet, with weights of 0, and with
/// zeros added to animations of their weights.
Result<void> addTargets(Document& document, const Parts& parts,
                        const std::vector<std::string>& names);

}  // namespace sweepface::gltf
