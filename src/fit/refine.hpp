#pragma once

#include "fit/errors.hpp"

namespace sweepface {

struct RefineLimits {
  double distance;  ///< model units
  double angle;     ///< degrees
  bool smooth;      ///< normals matter: tangents may not be given up for points
  double trace;     ///< what an expression does to a vector counts from here on; model units
};

/// Splits every patch that breaks a limit where that promises most, and lets vertices count more
/// that no split can help. Returns how much it changed.
Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
             const RefineLimits& limits, ExtraJets& extra);

}  // namespace sweepface
