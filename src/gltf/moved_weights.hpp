#pragma once

#include <optional>

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Whose morph target weights a channel animates, all of them together: those of a node or, by
/// KHR_animation_pointer, of a mesh.
struct MovedWeights {
  bool ofNode = true;
  std::size_t number = 0;  ///< in the list of nodes, or of meshes
};

/// Read from a channel's target; nothing if that is something else.
std::optional<MovedWeights> movedWeights(const Document& document, const Json& target);

}  // namespace sweepface::gltf
