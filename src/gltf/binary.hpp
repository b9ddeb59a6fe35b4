#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Moves all bytes that something still refers to into one buffer, buffer 0, and returns them.
/// `touched` are views of which some bytes are needed no longer. Views that nothing refers to are
/// removed, or shrink to a few bytes where an unknown extension may count views.
std::string gatherBinary(Document& document, const std::vector<bool>& touched);

}  // namespace sweepface::gltf
