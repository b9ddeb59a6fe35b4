#pragma once

#include <vector>

#include "gltf/affine.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// [nodes] the global transform of each. Refuses trees with cycles and nodes with two parents.
Result<std::vector<Affine>> worldMatrices(const Document& document);

/// [nodes] whether each is one of the roots or below one.
std::vector<bool> nodesBelow(const Document& document, std::vector<std::size_t> roots);
/// [nodes] whether each is in any scene; without scenes, all are.
std::vector<bool> nodesOfScenes(const Document& document);
/// [nodes] whether each is in the scene that viewers show: the one that the file names, or else the
/// first; without scenes, all are.
std::vector<bool> shownNodes(const Document& document);

}  // namespace sweepface::gltf
