#pragma once

#include <vector>

#include "sweepface/vec.hpp"

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// TEXCOORD_0 of a primitive as OBJ counts: from the lower left, after the transform that its base
/// colour has them go through (KHR_texture_transform; quantised ones need it). The primitive has
/// them.
Result<std::vector<Vec2>> readTexcoords(const Document& document, const Json& primitive);

/// Whether a primitive has TEXCOORD_0 of single precision that no transform changes, so that they
/// can be told from what readTexcoords() gives.
bool hasPlainTexcoords(const Document& document, const Json& primitive);

}  // namespace sweepface::gltf
