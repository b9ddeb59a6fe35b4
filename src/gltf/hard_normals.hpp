#pragma once

#include <span>
#include <string>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A sentence about places of the face whose vertices have normals far apart, as with flat shading
/// and sharp edges: the surface has one normal at each. Empty if there are hardly any. `places` is
/// the result of weld() for the parts' vertices.
std::string hardNormals(const Document& document, const Parts& parts,
                        std::span<const Index> places);

}  // namespace sweepface::gltf
