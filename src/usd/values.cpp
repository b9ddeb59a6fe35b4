#include "usd/values.hpp"

#include <array>
#include <charconv>
#include <fmt/format.h>

#include "codec/utf8.hpp"

namespace sweepface::usd {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> digits;
  const float single = static_cast<float>(value) + 0.0f;  // no -0
  text.append(digits.data(),
              std::to_chars(digits.data(), digits.data() + digits.size(), single).ptr);
}

void append(std::string& text, std::span<const double> numbers) {
  text += '(';
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0) text += ", ";
    append(text, numbers[k]);
  }
  text += ')';
}
void append(std::string& text, const Vec2& p) { append(text, std::array{p.x, p.y}); }
void append(std::string& text, const Vec3& p) { append(text, std::array{p.x, p.y, p.z}); }
void append(std::string& text, Index number) { text += std::to_string(number); }
void append(std::string& text, const std::string& string) { text += inQuotes(string); }

template <typename T>
std::string listOf(std::span<const T> values) {
  std::string text = "[";
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) text += ", ";
    append(text, values[k]);
  }
  return text += ']';
}

}  // namespace

std::string inQuotes(std::string_view text) {
  const bool isUtf8 = codec::isUtf8(text);
  // As OpenUSD writes them; some readers do not know \".
  const char quote = text.contains('"') && !text.contains('\'') ? '\'' : '"';
  std::string result(1, quote);
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == quote || c == '\\') result += '\\';
    if (code < ' ' || code == 0x7F)
      result += fmt::format("\\x{:02x}", code);
    else if (code > 0x7F && !isUtf8)
      result += "\uFFFD";
    else
      result += c;
  }
  return result += quote;
}

std::string number(double value) {
  std::string text;
  append(text, value);
  return text;
}

std::string tuple(std::span<const double> numbers) {
  std::string text;
  append(text, numbers);
  return text;
}

std::string list(std::span<const std::string> texts) { return listOf(texts); }
std::string list(std::span<const Index> numbers) { return listOf(numbers); }
std::string list(std::span<const double> numbers) { return listOf(numbers); }
std::string list(std::span<const Vec2> points) { return listOf(points); }
std::string list(std::span<const Vec3> points) { return listOf(points); }

}  // namespace sweepface::usd
