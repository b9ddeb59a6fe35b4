#pragma once

#include <vector>

namespace sweepface::bench {

using Floats = std::vector<float>;

/// A face as morph targets, as a renderer has it: single precision, in the source's vertex order.
struct Morphs {
  Floats neutral, neutralNormals;   ///< [V × 3]
  std::vector<Floats> differences;  ///< [targets][V × 3]
  std::vector<Floats> normalDifferences;
  std::size_t floats() const { return neutral.size(); }
};

/// The morph targets of `face()`: from the source meshes that SWEEPFACE_BENCH_NEUTRAL and
/// SWEEPFACE_BENCH_TARGETS (paths with ':' between them) name, or else from the face itself.
const Morphs& morphs();

/// neutral + Σ weight · difference in double precision.
std::vector<double> exactBlend(const Floats& neutral, const std::vector<Floats>& differences,
                               const std::vector<double>& weights);

}  // namespace sweepface::bench
