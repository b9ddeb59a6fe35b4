#pragma once

#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::gltf {

/// A zlib stream (RFC 1950) as small as zlib makes it.
std::string deflated(std::string_view bytes);

/// What a stream of so many bytes may hold. JSON and meshes stay far below, and few bytes cannot
/// claim gigabytes.
constexpr std::size_t mostInflated(std::size_t bytes) { return (1 << 16) + 256 * bytes; }

/// What a zlib stream holds. Refuses streams that are damaged, that something follows, or that hold
/// too much.
Result<std::string> inflated(std::string_view stream);

}  // namespace sweepface::gltf
