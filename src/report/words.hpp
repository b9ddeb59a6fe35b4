#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "sweepface/picture.hpp"

#include "picture/number.hpp"
#include "report/colours.hpp"
#include "report/html.hpp"

// What the sections of a report have in common.
namespace sweepface {

inline constexpr PictureSize kPanel{520, 650};

/// A number with commas between thousands.
inline std::string count(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t k = digits.size(); k > 3; k -= 3) digits.insert(k - 3, ",");
  return digits;
}
inline std::string count(Index n) { return count(static_cast<std::size_t>(n)); }

/// With a true minus sign if negative.
inline std::string percent(double share) {
  return fmt::format("{}{:.1f} %", share < 0 ? "−" : "", 100 * std::abs(share));
}

/// Nothing if there is no text.
inline std::string paragraph(std::string_view text) {
  return text.empty() ? "" : fmt::format("<p>{}</p>\n", html::escaped(text));
}

inline std::string section(std::string_view title, std::string_view text) {
  return fmt::format("<h2>{}</h2>\n{}", html::escaped(title), paragraph(text));
}

/// Figures or plots side by side: "pair", "four" or "plots".
inline std::string row(const std::string& figures, std::string_view kind = "pair") {
  return fmt::format("<div class=\"row {}\">{}</div>\n", kind, figures);
}

}  // namespace sweepface
