#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::io {

/// The parser of nlohmann-json keeps a stack of its own, but its values are freed by recursion.
inline bool isTooDeep(std::string_view text, int most) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > most) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// The JSON in a small text file; messages call it `name`.
inline Result<nlohmann::json> parseJson(std::string_view text, std::string_view name) {
  if (isTooDeep(text, 64)) return fail(fmt::format("{} is nested too deeply.", name));
  nlohmann::json json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded())
    return fail(fmt::format("{} is not JSON; was the file cut short?", name));
  return json;
}

}  // namespace sweepface::io
