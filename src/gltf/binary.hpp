#pragma once

#include "gltf/document.hpp"

namespace sweepface::gltf {

/// Moves all bytes that something still refers to into one buffer, buffer 0, and returns them.
/// `touched` are views some of whose bytes are no longer needed. Views that nothing refers to are
/// removed; but where an unknown extension may refer to views by number, they stay as they are, or
/// shrink to a byte if they were touched.
std::string gatherBinary(Document& document, const std::vector<bool>& touched);

}  // namespace sweepface::gltf
