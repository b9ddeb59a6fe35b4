#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace sweepface {

/// The text in lower case, so that names are found however they are written.
inline std::string lowered(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace sweepface
