#pragma once

#include <string>
#include <vector>

namespace sweepface {

/// The values of a direction of a plot.
struct Scale {
  std::vector<double> ticks;
  bool logarithmic = false;
  double start = 0, end = 1;  ///< where they lie in the picture

  double at(double value) const;
};

/// What stands at the ticks: as short as they can be and still differ, without an exponent for the
/// sizes of ordinary things.
std::vector<std::string> labelsOf(const Scale& scale);

}  // namespace sweepface
