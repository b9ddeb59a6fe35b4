#pragma once

#include "fit/errors.hpp"

namespace sweepface {

struct RefineLimits {
  double distance;  ///< model units
  double angle;     ///< degrees
  bool smooth;      ///< normals matter: tangents may not be given up for points
  double trace;     ///< an expression's smaller changes of a vector are dropped; model units
};

/// Splits every patch that breaks a limit where that promises most, and gives more weight to
/// vertices that no split can help. Returns the number of changes.
Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
             const RefineLimits& limits, ExtraJets& extra);

}  // namespace sweepface
