#pragma once

#include <utility>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// For every vertex, the first one at the same place in the neutral and in every target.
std::vector<Index> weld(const MeshRig& rig);

/// Joins the ends of open edges that would be one edge, or one point, if copies had been rounded
/// alike: ends that are at most `within` apart in every pose, and at most a thousandth of any of
/// their edges that is longer than `within` in the neutral. Returns the largest distance of any
/// vertex from the one that `first` now names.
double weldRounded(const MeshRig& rig, double within, std::vector<Index>& first);

struct OpenSeams {
  Index vertices = 0;          ///< how many merging would remove
  Index one = -1, other = -1;  ///< the first two that it would join
  double widest = 0;
};
/// Vertices of open edges that run along others within `within` and a twentieth of their length in
/// all poses, and within `inNeutral` in the neutral: as in a face whose halves were mirrored but
/// not joined, or with targets that moved one side of a seam alone.
OpenSeams openSeams(const MeshRig& rig, double within, double inNeutral,
                    const std::vector<Index>& first);

/// Separate sheets that merely touch must not be welded: they would meet in edges of three or more
/// faces. Undoes the welds at the ends of such edges; false if there were none.
bool takeApart(std::vector<Index>& first, const std::vector<std::pair<Index, Index>>& edges);

}  // namespace sweepface
