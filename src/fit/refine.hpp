#pragma once

#include "fit/errors.hpp"

namespace sweepface {

struct Limits {
  double distance;  ///< model units
  double angle;     ///< degrees
};

/// Which vertices of the mesh, as nodes, store their whole jet because its prediction would run in a circle.
using WholeJets = std::vector<char>;

/// Reads the patches and the surface off a layout. Circles of derivations are broken by letting nodes
/// store their jets or by running lines on; both are remembered in the layout and in `wholeJets`.
Result<Draft> makeDraft(Layout& layout, WholeJets& wholeJets);

/// Splits every patch that breaks a limit where that promises most, and lets vertices count more that
/// no split can help. Returns how many patches it changed.
Index refine(Layout& layout, const Draft& draft, SourceData& data, const DraftErrors& errors, const Limits& limits);

}  // namespace sweepface
