#pragma once

#include <vector>

#include "gltf/affine.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// For every node how it places things in its scene. Refuses trees with cycles and nodes of two
/// parents.
Result<std::vector<Affine>> worldMatrices(const Document& document);

/// Whether any scene has each node [nodes]; where there are no scenes, all.
std::vector<bool> nodesOfScenes(const Document& document);

}  // namespace sweepface::gltf
