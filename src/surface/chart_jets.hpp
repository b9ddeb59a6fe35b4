#pragma once

#include "sweepface/result.hpp"

#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"

namespace sweepface {

/// Writes the jets of all corners at irregular points. Near such a point the surface is F(x, y) =
/// p + A x + B y + ½ (C x² + 2 D x y + E y²) over the chart of its valence; corners have the jets
/// of F composed with the chart's corner maps (docs/wireframe.md). Fails at a point where no corner
/// spans an angle because every one has a collapsed side.
Result<void> chartHubs(const Wireframe& wireframe, const Connectivity& connectivity,
                       const JetNumbers& numbers, JetRows& rows);

/// Writes the jets of all corners at creased nodes. Every fan has its own jet, in axes or in a
/// chart, and takes the derivatives that it shares with earlier fans from them.
void chartFans(const Connectivity& connectivity, const JetNumbers& numbers, JetRows& rows);

}  // namespace sweepface
