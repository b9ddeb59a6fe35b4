#pragma once

#include <string>
#include <string_view>

namespace sweepface::gltf {

/// The media type of an image as its first bytes tell it, e.g. image/png; empty if they do not.
std::string imageTypeOf(std::string_view bytes);

}  // namespace sweepface::gltf
