#pragma once

#include <cstdlib>
#include <fmt/format.h>
#include <string>

#include "sweepface/result.hpp"

namespace sweepface::bench {

/// Says why nothing can be measured, and ends the program.
[[noreturn]] inline void giveUp(const std::string& why) {
  fmt::print(stderr, "sweepface_bench: {}\n", why);
  std::exit(1);
}

/// The value of a result; an error ends the program.
template <typename T>
T orEnd(Result<T> result) {
  if (!result) giveUp(result.error().message);
  return std::move(*result);
}

}  // namespace sweepface::bench
