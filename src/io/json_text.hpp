#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string_view>

#include "sweepface/result.hpp"

namespace sweepface::io {

/// Hands every character of a JSON text that is in no string to `see`, and the quote that opens
/// one, until that answers false.
template <typename See>
void scanJson(std::string_view text, See see) {
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\')
        ++i;
      else if (c == '"')
        inString = false;
      continue;
    }
    inString = c == '"';
    if (!see(c)) return;
  }
}

/// The parser of nlohmann-json keeps a stack of its own, but its values are freed by recursion.
inline bool isTooDeep(std::string_view text, int most) {
  int depth = 0;
  scanJson(text, [&](char c) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    return depth <= most;
  });
  return depth > most;
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
