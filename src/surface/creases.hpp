#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Whether an arc is a crease with patches on both sides.
bool isCrease(const Wireframe& wireframe, const Connectivity& connectivity, Index arc);

/// The fans into which creases cut a star; empty if too few creases meet there: a cut takes two, or
/// one at a boundary. Of `connectivity` only the links of the loops need to be set.
std::vector<Fan> fansOf(const Wireframe& wireframe, const Connectivity& connectivity,
                        const Star& star);

}  // namespace sweepface
