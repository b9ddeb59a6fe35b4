#pragma once

#include <cstdint>
#include <string>
#include <string_view>

// Numbers of 32 bits, little-endian.
namespace sweepface::gltf {

/// Reads the number at a place, where there must be four bytes.
inline std::uint32_t fixed32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  return value;
}

inline void append32(std::string& bytes, std::size_t value) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 255);
}

}  // namespace sweepface::gltf
