#pragma once

#include <utility>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// For every vertex the first that stands at the same place in the neutral and in every target.
std::vector<Index> weld(const MeshRig& rig);

/// Separate sheets that merely touch must not be welded: they would meet in edges of three and
/// more faces. Takes apart what was welded at the ends of such edges; false if there was nothing
/// to take apart.
bool takeApart(std::vector<Index>& first, const std::vector<std::pair<Index, Index>>& edges);

}  // namespace sweepface
