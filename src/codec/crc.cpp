// Eight bytes at a time (Kounavis and Berry, A Systematic Approach to Building High Performance
// Software-based CRC Generators, 2005).
#include "codec/crc.hpp"

#include <array>

namespace sweepface::codec {

namespace {

/// Entry [k][b]: the contribution of a byte b to the CRC k bytes later. Computed at first use
/// rather than constexpr, so that a browser need not load its 8 KB.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;
CrcTables makeCrcTables() {
  CrcTables t{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t c = b;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1 ? 0xEDB88320u : 0) ^ (c >> 1);
    t[0][b] = c;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t b = 0; b < 256; ++b) t[k][b] = t[0][t[k - 1][b] & 255] ^ (t[k - 1][b] >> 8);
  return t;
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  static const CrcTables t = makeCrcTables();
  const auto at = [&](std::size_t k) {
    return std::uint32_t{static_cast<unsigned char>(bytes[k])};
  };
  std::uint32_t c = ~before;
  std::size_t k = 0;
  for (; k + 8 <= bytes.size(); k += 8) {
    c ^= at(k) | at(k + 1) << 8 | at(k + 2) << 16 | at(k + 3) << 24;
    c = t[7][c & 255] ^ t[6][c >> 8 & 255] ^ t[5][c >> 16 & 255] ^ t[4][c >> 24] ^ t[3][at(k + 4)] ^
        t[2][at(k + 5)] ^ t[1][at(k + 6)] ^ t[0][at(k + 7)];
  }
  for (; k < bytes.size(); ++k) c = t[0][(c ^ at(k)) & 255] ^ (c >> 8);
  return ~c;
}

}  // namespace sweepface::codec
