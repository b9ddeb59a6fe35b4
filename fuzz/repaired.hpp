#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "codec/crc.hpp"

namespace sweepface::fuzzing {

inline std::uint32_t fixed32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * k);
  return value;
}

/// Corrects every checksum of a .sweep file: otherwise no mutation would get past them.
inline std::string repaired(std::string bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::string_view frame = std::string_view(bytes).substr(at);
    const std::size_t size = fixed32(frame.substr(4));
    if (size > frame.size() - 12) break;
    const std::uint32_t sum =
        codec::crc32(frame.substr(12, size), codec::crc32(frame.substr(0, 4)));
    for (std::size_t k = 0; k < 4; ++k) bytes[at + 8 + k] = static_cast<char>(sum >> (8 * k) & 255);
    at += 12 + size;
  }
  return bytes;
}

}  // namespace sweepface::fuzzing
