#pragma once

#include <vector>

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Recomputes `min` and `max`, where given, of float accessors in rounded views [views]: filters
/// round what they compress, but files state the bounds from before.
void correctBounds(Document& document, const std::vector<bool>& rounded);

}  // namespace sweepface::gltf
