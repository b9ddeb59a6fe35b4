#pragma once

#include <cstdint>
#include <string_view>

namespace sweepface::codec {

/// The CRC-32 of zip and PNG (polynomial 0xEDB88320). `before` is the CRC of the preceding bytes.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace sweepface::codec
