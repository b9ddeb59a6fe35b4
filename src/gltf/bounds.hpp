#pragma once

#include <vector>

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Filters round what they compress, and files tell the bounds from before: makes `min` and `max`,
/// where an accessor of floats in a rounded view [views] has them, those of its numbers.
void correctBounds(Document& document, const std::vector<bool>& rounded);

}  // namespace sweepface::gltf
