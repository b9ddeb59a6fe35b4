#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Whether scenes, nodes, skins, animations, textures, and what accessors and materials are named
/// by, name what exists: it is passed on unread, and would come to name what is added, or stop the
/// programs that open the face. Also that animations have as many values as their keys need, and
/// that skins have finite matrices and all joints that vertices hang on.
Result<void> checkReferences(const Document& document);

}  // namespace sweepface::gltf
