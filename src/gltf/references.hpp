#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Whether what is passed on unread names what exists, in the lists of glTF itself: else it would
/// come to name what is added, or stop the programs that open the face. Also that animations have
/// as many values as their keys need, and that skins have finite matrices and all joints that
/// vertices hang on.
Result<void> checkReferences(const Document& document);

}  // namespace sweepface::gltf
