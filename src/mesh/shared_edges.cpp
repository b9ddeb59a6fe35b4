#include "mesh/shared_edges.hpp"

namespace sweepface {

std::vector<std::pair<Index, Index>> pairSides(std::vector<EdgeSide>& sides,
                                               std::span<Index> twin) {
  std::ranges::fill(twin, -1);
  std::vector<std::pair<Index, Index>> others;
  eachSharedEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() == 2 && edge[0].isUp != edge[1].isUp) {
      twin[edge[0].at] = edge[1].at;
      twin[edge[1].at] = edge[0].at;
    } else if (edge.size() > 1) {
      others.emplace_back(edge[0].low, edge[0].high);
    }
  });
  return others;
}

}  // namespace sweepface
