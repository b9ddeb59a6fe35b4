#include "codec/edge_map.hpp"

#include <algorithm>

namespace sweepface::codec {

EdgeMap::EdgeMap(std::span<const Edge> edges, Index ends) {
  std::vector<Index> keys;
  keys.reserve(edges.size());
  for (const Edge& edge : edges) keys.push_back(edge.to + 1);
  const Groups arriving(keys, ends + 1);
  keys.clear();
  for (Index to = -1; to < ends; ++to)
    for (const Index e : arriving.of(to + 1)) {
      number_.push_back(e);
      to_.push_back(to);
      keys.push_back(edges[e].from + 1);
    }
  leaving_.emplace(keys, ends + 1);
}

Index EdgeMap::find(Index from, Index to) const {
  const auto places = leaving_->of(from + 1);
  const auto at = std::ranges::lower_bound(places, to, {}, [&](Index p) { return to_[p]; });
  return at != places.end() && to_[*at] == to ? number_[*at] : -1;
}

}  // namespace sweepface::codec
