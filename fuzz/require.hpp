#pragma once

#include <cstdlib>
#include <string_view>

namespace sweepface::fuzzing {

/// Aborts if a property does not hold, which is what a fuzzer looks for.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Whether an error's message is a whole sentence, or ends with a question about the file.
inline bool isSentence(std::string_view message) {
  return message.ends_with('.') || message.ends_with('?');
}

}  // namespace sweepface::fuzzing
