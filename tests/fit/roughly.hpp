#pragma once

#include "sweepface/fit.hpp"

#include "faces.hpp"

namespace sweepface::testing {

/// A source converted within a hundredth of its size.
inline Rig roughly(const MeshRig& source) {
  ConvertOptions options;
  options.tolerance = 0.01 * diagonal(source.neutral);
  return convert(source, options).value().rig;
}

}  // namespace sweepface::testing
