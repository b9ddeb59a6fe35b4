#pragma once

#include "fit/errors.hpp"

namespace sweepface {

struct RefineLimits {
  double distance;  ///< model units
  double angle;     ///< degrees
  bool smooth;      ///< normals matter: tangents may not be given up for points
};

/// What a vertex of the mesh stores as a node beyond what the layout grants it: its slopes where
/// lines pass from a long edge to a short one, because predicted slopes overshoot there; its whole
/// jet where its prediction would run in a circle.
using ExtraJets = std::vector<JetMask>;
inline constexpr JetMask kSlopes = kPosition | 1 << 1 | 1 << 3;

/// Reads the patches and the surface off a layout. Circles of derivations are broken by letting
/// nodes store their jets or by running lines on; both are remembered in the layout and in `extra`.
Result<Draft> makeDraft(Layout& layout, ExtraJets& extra);

/// Splits every patch that breaks a limit where that promises most, and lets vertices count more
/// that no split can help. Returns how many patches it changed.
Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors,
             const RefineLimits& limits, ExtraJets& extra);

}  // namespace sweepface
