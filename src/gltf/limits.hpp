#pragma once

#include "gltf/document.hpp"

// Few bytes can claim much: targets without data, accessors that are used again and again. Files
// that mean what they say stay below these, however well they are compressed.

namespace sweepface::gltf {

inline constexpr std::size_t alwaysAllowed = 1 << 16;

/// How many places of vertices, in all shapes together, a file of this size can mean.
inline std::size_t mostVectors(const Document& document) {
  return alwaysAllowed + 32 * document.sourceBytes;
}

/// The same for corners, texture coordinates and elements of other attributes.
inline std::size_t mostElements(const Document& document) {
  return alwaysAllowed + 8 * document.sourceBytes;
}

}  // namespace sweepface::gltf
