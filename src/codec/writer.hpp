#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace sweepface::codec {

/// Appends values to a chunk's payload.
class Writer {
 public:
  void byte(unsigned value) { bytes_ += static_cast<char>(value); }

  /// LEB128: seven bits per byte, low ones first, with the top bit set in all bytes but the last.
  void number(std::uint64_t value) {
    for (; value >= 128; value >>= 7) byte(static_cast<unsigned>(value & 127) | 128);
    byte(static_cast<unsigned>(value));
  }

  /// Zig-zag: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
  void signedNumber(std::int64_t value) {
    number((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
  }

  void f32(float value) { fixed(std::bit_cast<std::uint32_t>(value)); }
  void f64(double value) { fixed(std::bit_cast<std::uint64_t>(value)); }

  void text(std::string_view text) {
    number(text.size());
    bytes_ += text;
  }

  /// Fixed width, little endian.
  template <typename T>
  void fixed(T value) {
    for (std::size_t k = 0; k < sizeof(T); ++k) byte(static_cast<unsigned>(value >> (8 * k) & 255));
  }

  void raw(std::string_view bytes) { bytes_ += bytes; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace sweepface::codec
