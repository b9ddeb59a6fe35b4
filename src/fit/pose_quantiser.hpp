#pragma once

#include <functional>
#include <vector>

#include "codec/lattice.hpp"
#include "fit/columns.hpp"
#include "fit/slopes.hpp"

namespace sweepface {

/// One pose to be quantised.
struct PoseTask {
  double step = 0;
  codec::Symmetry symmetry = codec::Symmetry::none;
  codec::Coefficients expected;  ///< what an image predicts, for Symmetry::partner
  std::vector<Vec3> errors;      ///< [vertices] how far off the pose is at first
  std::vector<float> bounds;     ///< [vertices] how far off it may be
  Slopes slopes;
  std::vector<float> stress;  ///< [vertices] or empty: factor on the tangents' errors there
  std::vector<char> frozen;   ///< [S] or empty: stays unless a bound is exceeded
};

/// Looks for coefficients that cost few bits while vertex errors stay within their bounds:
/// coordinate descent on bits + penalty(errors), one coefficient after the other, from those
/// given. The caller must check that the errors did stay within their bounds. Ends early if
/// `goesOn`, which is polled between sweeps, returns false.
void quantisePose(const codec::Lattice& lattice, const Columns& columns, PoseTask task,
                  codec::Coefficients& q, const std::function<bool()>& goesOn);

}  // namespace sweepface
