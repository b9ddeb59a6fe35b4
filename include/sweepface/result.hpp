#pragma once

#include <concepts>
#include <expected>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace sweepface {

/// Why a call failed: one sentence that a user can act on.
struct Error {
  std::string message;

  // Not inlined: failures are many and rare, and a browser loads all that makes them.
  [[gnu::noinline]] Error(std::string sentence) : message(std::move(sentence)) {}
  [[gnu::noinline]] Error(const Error& other) : message(other.message) {}
  [[gnu::noinline]] Error(Error&& other) noexcept : message(std::move(other.message)) {}
  [[gnu::noinline]] ~Error() {}
  Error& operator=(const Error& other) = default;
  Error& operator=(Error&& other) noexcept = default;
};

/// A value or the reason there is none. Nothing in this library throws.
template <typename T>
using Result = std::expected<T, Error>;

/// A part of a sentence: text, or a whole number.
struct TextPart {
  std::string_view text;
  long long number = 0;

  template <std::integral T>
  TextPart(T x) : number(static_cast<long long>(x)) {}
  template <std::convertible_to<std::string_view> T>
  TextPart(const T& x) : text(x) {}
};

/// Appends a whole number: one function for all types, where the standard library has one for each.
[[gnu::noinline]] inline void appendNumber(std::string& sentence, long long number) {
  char digits[20];
  char* first = digits + 20;
  auto rest = static_cast<unsigned long long>(number);
  if (number < 0) rest = 0 - rest;
  do *--first = static_cast<char>('0' + rest % 10);
  while (rest /= 10);
  if (number < 0) *--first = '-';
  sentence.append(first, digits + 20);
}

/// The parts one after the other.
[[gnu::noinline]] inline std::string joined(std::initializer_list<TextPart> parts) {
  std::string sentence;
  for (const TextPart& part : parts)
    if (part.text.data())
      sentence += part.text;
    else
      appendNumber(sentence, part.number);
  return sentence;
}

/// Shorthand for a failed Result.
[[gnu::noinline]] inline std::unexpected<Error> fail(std::string message) {
  return std::unexpected(Error(std::move(message)));
}
[[gnu::noinline]] inline std::unexpected<Error> failWith(std::initializer_list<TextPart> parts) {
  return fail(joined(parts));
}
template <typename... Parts>
std::unexpected<Error> fail(const char* first, const Parts&... rest) {
  return failWith({TextPart(first), TextPart(rest)...});
}

}  // namespace sweepface
