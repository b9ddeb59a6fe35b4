#pragma once

#include <set>
#include <string>
#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// [meshes] the primitives that are not of the face.
std::vector<std::set<std::size_t>> otherPrimitives(const Document& document, const Parts& parts);

/// Sentences about meshes that only a GLB of the face shows: those without morph targets if others
/// have some, and further nodes that show the same mesh.
std::vector<std::string> leftOut(const Document& document, const Parts& parts);

}  // namespace sweepface::gltf
