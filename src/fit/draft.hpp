#pragma once

#include <vector>

#include "layout/layout.hpp"

namespace sweepface {

/// A layout with its surface: what one round of fitting works on.
struct Draft {
  std::vector<GridPatch> patches;  ///< in the order of the surface's patches
  Surface surface;
};

/// What each vertex of the mesh, if it is a node, stores beyond what the layout grants it: its
/// slopes where lines pass from a long edge to a short one, because predicted slopes overshoot
/// there; its whole jet where its prediction would be circular.
using ExtraJets = std::vector<JetMask>;
inline constexpr JetMask kSlopes = kPosition | 1 << 1 | 1 << 3;

/// Reads the patches and the surface off a layout. Breaks circular derivations by letting nodes
/// store their jets or by extending lines, and records this in `extra` and in the layout.
Result<Draft> makeDraft(Layout& layout, ExtraJets& extra);

}  // namespace sweepface
