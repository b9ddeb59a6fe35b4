#pragma once

#include <concepts>
#include <expected>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#ifndef __cpp_lib_expected
#error "sweepface takes C++23: compile with -std=c++23, with the library of GCC 12 or later"
#endif

namespace sweepface {

/// Why a call failed: one sentence that a user can act on.
struct Error {
  std::string message;

  // Not inlined: failures are made in many places but rarely happen, and a browser loads all that
  // code.
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

/// A part of a sentence: text, or a whole number (kMost for those that are too large).
struct TextPart {
  static constexpr long long kMost = std::numeric_limits<long long>::max();

  static constexpr char kIsNumber = 0;

  std::string_view text;  ///< for a number: that mark, and no characters
  long long number = 0;

  template <std::integral T>
  [[gnu::always_inline]] TextPart(T x)
      : text(&kIsNumber, 0),
        number(std::in_range<long long>(x) ? static_cast<long long>(x) : kMost) {}
  template <std::convertible_to<std::string_view> T>
  [[gnu::always_inline]] TextPart(const T& x) : text(x) {}
};

/// The parts one after the other.
std::string joined(std::initializer_list<TextPart> parts);

/// Shorthand for a failed Result. A program that has no use for messages can leave them out by
/// linking a failWith() of its own (web/src/usual.cpp).
std::unexpected<Error> failWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline std::unexpected<Error> fail(const Parts&... parts) {
  return failWith({TextPart(parts)...});
}

/// The same for errors in what the caller asks for rather than in their data: every program reports
/// these.
std::unexpected<Error> failCallWith(std::initializer_list<TextPart> parts);
template <typename... Parts>
[[gnu::always_inline]] inline std::unexpected<Error> failCall(const Parts&... parts) {
  return failCallWith({TextPart(parts)...});
}

}  // namespace sweepface
