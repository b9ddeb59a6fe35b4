#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Whether an arc is a crease with patches on both sides.
bool isCrease(const Wireframe& wireframe, const Connectivity& connectivity, Index arc);

/// The fans into which creases cut a star; none where too few creases meet to cut it: two, or one
/// at a boundary. `connectivity` needs its links only.
std::vector<Fan> fansOf(const Wireframe& wireframe, const Connectivity& connectivity,
                        const Star& star);

}  // namespace sweepface
