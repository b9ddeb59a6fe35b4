#include "codec/edge_map.hpp"

#include <algorithm>

#include "surface/sorting.hpp"

namespace sweepface::codec {

EdgeMap::EdgeMap(std::span<const Edge> edges, Index ends)
    : first_(ends + 2), sorted_(edges.size()) {
  for (const Edge& edge : edges) ++first_[edge.from + 1];
  Index end = 0;
  for (Index& first : first_) first = end += first;
  for (Index e = 0; e < std::ssize(edges); ++e)
    sorted_[--first_[edges[e].from + 1]] = {edges[e].to, e};
  for (Index from = -1; from < ends; ++from)
    sortSmall(
        std::span(sorted_).subspan(first_[from + 1], countFrom(from)),
        [](const End& a, const End& b) { return a.to != b.to ? a.to < b.to : a.edge < b.edge; });
}

Index EdgeMap::find(Index from, Index to) const {
  const auto edges = std::span(sorted_).subspan(first_[from + 1], countFrom(from));
  const auto found = std::ranges::lower_bound(edges, to, {}, &End::to);
  return found != edges.end() && found->to == to ? found->edge : -1;
}

}  // namespace sweepface::codec
