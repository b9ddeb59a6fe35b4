#pragma once

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "io/text.hpp"

namespace sweepface::io {

/// Calls `see` with the position of every character of a JSON text outside strings, and of every
/// quote that opens a string, until it returns false.
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
    if (!see(i)) return;
  }
}

/// Whether values are nested more than `most` deep. The parser of nlohmann-json keeps a stack of
/// its own, but frees its values by recursion.
inline bool isTooDeep(std::string_view text, int most) {
  int depth = 0;
  scanJson(text, [&](std::size_t at) {
    const char c = text[at];
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    return depth <= most;
  });
  return depth > most;
}

/// Finds keys that occur twice in an object; a parser silently takes the last. (As the callback of
/// a parser it would take time in proportion to the square of a list's length.)
class TwiceNamed : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::optional<std::string> found;  ///< the last such key

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool start_object(std::size_t) override {
    open_.emplace_back();
    return true;
  }
  bool end_object() override {
    open_.pop_back();
    return true;
  }
  bool key(string_t& name) override {
    if (!open_.back().insert(name).second) found = name;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  std::vector<std::set<std::string>> open_;
};

/// Says where a parser stopped because there was no JSON, given the byte, counted from 1.
inline std::string whereNoJson(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::max<std::size_t>(byte, 1) - 1);
  const auto line = 1 + std::ranges::count(before, '\n');
  if (byte > text.size())
    return fmt::format("line {}: this is not JSON; was the file cut short?", line);
  const std::size_t column = before.size() - (before.rfind('\n') + 1);
  // A parser may stop within a word, all of which should be shown.
  std::size_t from = before.size();
  while (from > 0 && before.size() - from < 20 &&
         std::isalpha(static_cast<unsigned char>(text[from - 1])))
    --from;
  return fmt::format("line {}: this is not JSON, at column {}: {}.", line, column + 1,
                     inQuotes(text.substr(from, 20)));
}

/// The JSON in a small text file; messages call it `name`.
inline Result<nlohmann::json> parseJson(std::string_view text, std::string_view name) {
  if (isUtf16(text)) return fail(fmt::format("{} is a text in UTF-16; save it in UTF-8.", name));
  if (isTooDeep(text, 64)) return fail(fmt::format("{} is nested too deeply.", name));
  try {
    nlohmann::json json = nlohmann::json::parse(text);
    TwiceNamed twice;
    nlohmann::json::sax_parse(text, &twice);
    if (twice.found)
      return fail(
          fmt::format("{} has the key '{}' twice in one object; keep one.", name, *twice.found));
    return json;
  } catch (const nlohmann::json::parse_error& error) {
    return fail(fmt::format("{}, {}", name, whereNoJson(text, error.byte)));
  } catch (const nlohmann::json::out_of_range&) {
    return fail(fmt::format("{} has a number that is too large to be held.", name));
  }
}

}  // namespace sweepface::io
