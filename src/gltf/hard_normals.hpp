#pragma once

#include <span>
#include <string>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A sentence about places of the face whose vertices have normals that are far from each other, as
/// flat shading and sharp edges have them: the surface has one normal at each. Empty where there
/// are hardly any. `places` is what weld() says of the parts' vertices.
std::string hardNormals(const Document& document, const Parts& parts,
                        std::span<const Index> places);

}  // namespace sweepface::gltf
