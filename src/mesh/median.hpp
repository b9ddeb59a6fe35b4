#pragma once

#include <algorithm>
#include <vector>

namespace sweepface {

/// The larger of the two middle values if their number is even; 0 if there are none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace sweepface
