#pragma once

#include <vector>

#include "gltf/affine.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// For every node how it places things in its scene. Refuses trees with cycles and nodes of two
/// parents.
Result<std::vector<Affine>> worldMatrices(const Document& document);

/// Whether the scene that the file shows first has each node [nodes]; where there is none, all.
std::vector<bool> nodesOfScene(const Document& document);

}  // namespace sweepface::gltf
