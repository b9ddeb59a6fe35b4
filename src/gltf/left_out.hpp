#pragma once

#include <string>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// Sentences about meshes that only a GLB of the face shows: those without morph targets if others
/// have some, and further nodes that show the same mesh.
std::vector<std::string> leftOut(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
