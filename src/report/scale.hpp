#pragma once

#include <string>
#include <vector>

namespace sweepface {

/// The scale of an axis of a plot.
struct Scale {
  std::vector<double> ticks;
  bool logarithmic = false;
  double start = 0, end = 1;  ///< its ends in the picture

  double at(double value) const;
};

/// The labels of the ticks: as short as they can be and still differ, without an exponent for
/// numbers of ordinary size.
std::vector<std::string> labelsOf(const Scale& scale);

}  // namespace sweepface
