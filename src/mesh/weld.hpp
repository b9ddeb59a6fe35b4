#pragma once

#include <utility>
#include <vector>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// For every vertex the first that stands at the same place in the neutral and in every target.
std::vector<Index> weld(const MeshRig& rig);

/// Joins the ends of open edges that would be one, or all one point, if copies had not been rounded
/// otherwise: ends that are no further apart in any pose than `within`, nor than a thousandth of
/// their longer edges in the neutral. Returns the largest distance of any vertex from the one that
/// `first` names now.
double weldRounded(const MeshRig& rig, double within, std::vector<Index>& first);

/// Vertices of open edges that run along others within `within` and a twentieth of their length in
/// all poses, as the halves of a face that were mirrored and not joined.
struct OpenSeams {
  Index vertices = 0;          ///< that merging would take away
  Index one = -1, other = -1;  ///< the first two that it would join
  double widest = 0;
};
OpenSeams openSeams(const MeshRig& rig, double within, const std::vector<Index>& first);

/// Separate sheets that merely touch must not be welded: they would meet in edges of three and
/// more faces. Takes apart what was welded at the ends of such edges; false if there was nothing
/// to take apart.
bool takeApart(std::vector<Index>& first, const std::vector<std::pair<Index, Index>>& edges);

}  // namespace sweepface
