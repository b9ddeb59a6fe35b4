#pragma once

#include <vector>

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// For every vertex the first one of its run at the same place that agrees with it in everything
/// but its normal and tangent: exporters double vertices for their sake. `places` numbers the
/// places, one a vertex. Empty where attributes are damaged or too many.
std::vector<Index> copiesOf(const Document& document, const Parts& parts,
                            const std::vector<Index>& places);

}  // namespace sweepface::gltf
