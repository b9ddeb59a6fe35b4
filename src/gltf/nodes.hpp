#pragma once

#include <vector>

#include "gltf/affine.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// For every node how it places things in its scene. Refuses trees with cycles and nodes of two
/// parents.
Result<std::vector<Affine>> worldMatrices(const Document& document);

}  // namespace sweepface::gltf
