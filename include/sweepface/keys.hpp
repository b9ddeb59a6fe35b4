#pragma once

#include <span>
#include <string>
#include <vector>

#include "sweepface/clip.hpp"

namespace sweepface {

/// Weights over time as a cubic Hermite spline: what glTF calls CUBICSPLINE.
struct CubicKeys {
  std::vector<std::string> names;       ///< [N]
  std::vector<double> times;            ///< [K] seconds, increasing
  std::vector<double> in, values, out;  ///< [K × N] slopes before a key, the key, slopes after it

  /// Writes min(N, out.size()) values; the ends are held.
  void at(double time, std::span<double> weights) const noexcept;
};

/// As few keys as keep every weight within `tolerance` > 0 of the clip, at its frames and at three
/// places between them. Keys are at frames of the clip. Both ends are keys. A clip without frames
/// has none.
CubicKeys fewestKeys(const Clip& clip, double tolerance);

}  // namespace sweepface
