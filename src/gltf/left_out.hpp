#pragma once

#include <string>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Sentences about meshes that a GLB of the face shows and nothing else does: those without morph
/// targets beside some with, and what nodes show once more.
std::vector<std::string> leftOut(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
