#pragma once

#include <string_view>

namespace sweepface::codec {

/// Whether a text is well-formed UTF-8 without control characters below the space.
inline bool isUtf8(std::string_view text) {
  for (std::size_t k = 0; k < text.size();) {
    const auto at = [&](std::size_t i) {
      return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = at(k);
    const std::size_t more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    if (first < ' ' || (first >= 0x80 && first < 0xC2) || first > 0xF4) return false;
    for (std::size_t i = 1; i <= more; ++i)
      if ((at(k + i) & 0xC0) != 0x80) return false;
    const unsigned second = at(k + 1);  // longer than needed, surrogates, beyond U+10FFFF
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
      return false;
    k += 1 + more;
  }
  return true;
}

}  // namespace sweepface::codec
