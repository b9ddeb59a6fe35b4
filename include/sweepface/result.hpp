#pragma once

#include <expected>
#include <string>
#include <utility>

namespace sweepface {

/// Why a call failed: one sentence that a user can act on.
struct Error {
  std::string message;
};

/// A value or the reason there is none. Nothing in this library throws.
template <typename T>
using Result = std::expected<T, Error>;

/// Shorthand for a failed Result.
inline std::unexpected<Error> fail(std::string message) {
  return std::unexpected(Error{std::move(message)});
}

}  // namespace sweepface
