#pragma once

#include <array>
#include <vector>

#include "drawing/weave.hpp"
#include "surface/jet_numbers.hpp"

namespace sweepface::drawing {

/// Where crossings store the derivatives of the jets that a drawing gives them [nodes].
using JetAxes = std::vector<std::array<Turned, 9>>;

/// Lets every crossing store what its jet gives, or all there is where the curves must say it.
Result<JetAxes> chooseStored(const Drawing& drawing, Woven& woven);

/// A jet's curve does not leave its node.
std::unexpected<Error> leavesNot(const Drawing& drawing, Index node, std::size_t jet);

}  // namespace sweepface::drawing
