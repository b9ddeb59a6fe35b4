#pragma once

#include "sweepface/result.hpp"

#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"

namespace sweepface {

/// The jets of all corners at irregular points. Near one the surface is F(x, y) = p + A x + B y +
/// ½ (C x² + 2 D x y + E y²) over the chart of its valence; corners have the jets of F composed
/// with the chart's corner maps (docs/wireframe.md). Fails at a point around which no corner has
/// an angle, as all have a side that is one point.
Result<void> chartHubs(const Wireframe& wireframe, const Connectivity& connectivity,
                       const JetNumbers& numbers, JetRows& rows);

/// The jets of all corners at creased nodes: every fan has its own, in axes or in a chart, and
/// takes from the fans before it what they share.
void chartFans(const Connectivity& connectivity, const JetNumbers& numbers, JetRows& rows);

}  // namespace sweepface
