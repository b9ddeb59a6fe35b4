#pragma once

#include <array>
#include <vector>

#include "drawing/weave.hpp"
#include "surface/jet_numbers.hpp"

namespace sweepface::drawing {

/// For each crossing [nodes], the stored component and sign of each derivative of its drawn jet.
using JetAxes = std::vector<std::array<Turned, 9>>;

/// Makes every crossing store the derivatives that its jet gives, or the whole jet if it is to be
/// found from the curves.
Result<JetAxes> chooseStored(const Drawing& drawing, Woven& woven);

/// The error that a jet's curve does not leave its node.
std::unexpected<Error> leavesNot(const Drawing& drawing, Index node, std::size_t jet);

}  // namespace sweepface::drawing
