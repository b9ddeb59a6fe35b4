#pragma once

#include <array>
#include <vector>

#include "sweepface/vec.hpp"

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// What the base colour texture of a primitive's material does to TEXCOORD_0
/// (KHR_texture_transform; quantised ones need it): the offset, the scale, and a rotation in
/// radians, counter-clockwise with v pointing down.
using TextureTransform = std::array<double, 5>;
inline constexpr TextureTransform kNoTransform{0, 0, 1, 1, 0};
Result<TextureTransform> textureTransformOf(const Document& document, const Json& primitive);

/// TEXCOORD_0 of a primitive, which must have it, after a transform and with the origin at the
/// lower left, as in OBJ.
Result<std::vector<Vec2>> readTexcoords(const Document& document, const Json& primitive,
                                        const TextureTransform& transform);

/// Whether a primitive has TEXCOORD_0 in single precision that no transform changes, so that it can
/// be recovered from what readTexcoords() gives.
bool hasPlainTexcoords(const Document& document, const Json& primitive);

}  // namespace sweepface::gltf
