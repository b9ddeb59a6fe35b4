#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::gltf {

/// A zlib stream (RFC 1950) as small as zlib makes it.
std::string deflated(std::string_view bytes);

/// The most that a stream of this many bytes may hold, so that a few bytes cannot claim gigabytes.
/// JSON and meshes stay far below.
constexpr std::uint64_t mostInflated(std::uint64_t bytes) { return (1 << 16) + 256 * bytes; }

/// Inflates a zlib stream. Refuses streams that are damaged, are followed by something, or hold too
/// much.
Result<std::string> inflated(std::string_view stream);

}  // namespace sweepface::gltf
