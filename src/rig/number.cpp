#include "rig/number.hpp"

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>

namespace sweepface {

std::optional<double> numberOf(std::string_view text) {
  const bool plain = !text.empty() && text.find_first_not_of("0123456789+-.eE") == text.npos;
  if (!plain) return std::nullopt;
  // Not from_chars, which libc++ 19 lacks for floating point. strtod expects the locale's point.
  std::string digits(text);
  if (const auto point = digits.find('.'); point != digits.npos)
    digits.replace(point, 1, std::localeconv()->decimal_point);
  char* end = nullptr;
  const double value = std::strtod(digits.c_str(), &end);
  if (end != digits.c_str() + digits.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == text.npos ? "" : text.substr(first, last + 1 - first);
}

std::string_view takeItem(std::string_view& list) {
  const auto comma = list.find(',');
  const std::string_view item = trimmed(list.substr(0, comma));
  list = comma == list.npos ? "" : list.substr(comma + 1);
  return item;
}

}  // namespace sweepface
