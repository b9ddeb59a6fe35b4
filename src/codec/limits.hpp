#pragma once

#include <cstddef>

namespace sweepface::codec {

/// Vectors of all poses that a file may ask for: still ones take no bytes.
inline constexpr std::size_t kMostVectors = std::size_t{1} << 25, kVectorsAByte = 1024,
                             kVectorsAnyway = std::size_t{1} << 20;

}  // namespace sweepface::codec
