#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sweepface::codec {

/// The CRC-32 of zip and PNG (polynomial 0xEDB88320). `before` is the sum of the bytes that
/// precede.
inline std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  static constexpr auto table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t k = 0; k < 256; ++k) {
      std::uint32_t c = k;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1 ? 0xEDB88320u : 0) ^ (c >> 1);
      entries[k] = c;
    }
    return entries;
  }();
  std::uint32_t c = ~before;
  for (const char byte : bytes) c = table[(c ^ static_cast<unsigned char>(byte)) & 255] ^ (c >> 8);
  return ~c;
}

}  // namespace sweepface::codec
