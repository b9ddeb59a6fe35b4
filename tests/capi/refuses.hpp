#pragma once

#include <gtest/gtest.h>
#include <string_view>

#include "sweepface/sweepface.h"

namespace sweepface::testing {

/// Whether the call failed as expected with a sentence that has this part.
inline ::testing::AssertionResult refuses(sweepface_status status, std::string_view part,
                                          sweepface_status expected = SWEEPFACE_BAD_ARGUMENT) {
  const std::string_view message = sweepface_message();
  if (status != expected) return ::testing::AssertionFailure() << "it answered " << status;
  const bool isSentence = message.ends_with('.') || message.ends_with('?');
  if (message.find(part) == std::string_view::npos || !isSentence)
    return ::testing::AssertionFailure() << message;
  return ::testing::AssertionSuccess();
}

}  // namespace sweepface::testing
