#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

namespace sweepface {

/// To three digits, without an exponent for the sizes of ordinary things.
inline std::string number(double x) {
  const double size = std::abs(x);
  return size >= 999.5 && size < 1e7 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

}  // namespace sweepface
