#pragma once

#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// On which vertex of the tessellation at level 1 each face corner of the source stands [C], or -1
/// - k on loose vertex k. Where sheets touch at a vertex each has a place of its own, of which
/// `SourceMesh::gridVertex` names the first.
std::vector<Index> cornerPlaces(const SourceMesh& source, const Tessellation& level1);

/// A place of a vertex besides that which `gridVertex` names.
struct OtherPlace {
  Index vertex = 0, place = 0;
  friend auto operator<=>(const OtherPlace&, const OtherPlace&) = default;
};
/// Each once, in ascending order; none where no sheets touch.
std::vector<OtherPlace> otherPlaces(const SourceMesh& source,
                                    const std::vector<Index>& cornerPlaces);

}  // namespace sweepface
