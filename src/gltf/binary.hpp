#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Moves all bytes that something still refers to into one buffer, buffer 0, and returns them.
/// `touched` are views of which some bytes are needed no longer. Views that nothing refers to are
/// removed. Where an unknown extension may count views and refer to them they stay as they are, or
/// shrink to a byte if they were touched.
std::string gatherBinary(Document& document, const std::vector<bool>& touched);

}  // namespace sweepface::gltf
