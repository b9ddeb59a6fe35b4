#pragma once

#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// The vertex of the tessellation at level 1 at which each face corner of the source stands [C], or
/// -1 - k for loose vertex k. Where sheets touch at a vertex, each has a place of its own;
/// `SourceMesh::gridVertex` names only the first.
std::vector<Index> cornerPlaces(const SourceMesh& source, const Tessellation& level1);

/// A place of a vertex other than the one that `gridVertex` names.
struct OtherPlace {
  Index vertex = 0, place = 0;
  friend auto operator<=>(const OtherPlace&, const OtherPlace&) = default;
};
/// Each once, in ascending order; empty if no sheets touch.
std::vector<OtherPlace> otherPlaces(const SourceMesh& source,
                                    const std::vector<Index>& cornerPlaces);

}  // namespace sweepface
