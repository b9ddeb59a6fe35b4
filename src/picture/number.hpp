#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

namespace sweepface {

/// Formats to three digits, without an exponent for numbers of ordinary size.
inline std::string number(double x) {
  const double size = std::abs(x);
  return size >= 999.5 && size < 1e7 ? fmt::format("{:.0f}", x) : fmt::format("{:.3g}", x);
}

}  // namespace sweepface
