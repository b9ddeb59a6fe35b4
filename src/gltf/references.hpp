#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Checks that all references in scenes, nodes, skins, animations and textures, and those to
/// accessors and materials, name things that exist: they are passed on unread, and would come to
/// name things that are added, or stop the programs that open the face. Also checks that animations
/// have as many values as their keys need, and that skins have finite matrices and all joints that
/// vertices are bound to.
Result<void> checkReferences(const Document& document);

}  // namespace sweepface::gltf
