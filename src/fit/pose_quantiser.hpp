#pragma once

#include <vector>

#include "codec/lattice.hpp"
#include "fit/columns.hpp"
#include "fit/slopes.hpp"

namespace sweepface {

/// What is asked of one pose.
struct PoseTask {
  double step = 0;
  codec::Symmetry symmetry = codec::Symmetry::none;
  codec::Coefficients expected;  ///< what an image predicts, for Symmetry::partner
  std::vector<Vec3> errors;      ///< [vertices] how far off the pose is to begin with
  std::vector<float> bounds;     ///< [vertices] how far off it may be
  Slopes slopes;
  std::vector<float> stress;  ///< [vertices] or empty: times that tangents count there
  std::vector<char> frozen;   ///< [S] or empty: stays unless a bound is passed
};

/// Looks for coefficients that cost few bits while vertex errors stay within their bounds:
/// coordinate descent on  bits + penalty(errors), one coefficient after the other, from those
/// given. Whether they do stay within is for the caller to check.
void quantisePose(const codec::Lattice& lattice, const Columns& columns, PoseTask task,
                  codec::Coefficients& q);

}  // namespace sweepface
