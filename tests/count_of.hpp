#pragma once

#include <cstddef>
#include <string_view>

namespace sweepface::testing {

/// Number of occurrences of `part` in `text`.
inline std::size_t countOf(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace sweepface::testing
