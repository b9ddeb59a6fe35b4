#pragma once

#include <optional>

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Whose weights of morph targets a channel moves, all of them together: those of a node, or by
/// KHR_animation_pointer of a mesh.
struct MovedWeights {
  bool ofNode = true;
  std::size_t number = 0;  ///< in the list of nodes, or of meshes
};

/// By the target of a channel; nothing where that is something else.
std::optional<MovedWeights> movedWeights(const Document& document, const Json& target);

}  // namespace sweepface::gltf
