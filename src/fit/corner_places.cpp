#include "fit/corner_places.hpp"

#include <algorithm>

namespace sweepface {

std::vector<Index> cornerPlaces(const SourceMesh& source, const Tessellation& level1) {
  std::vector<Index> places;
  for (const Index v : source.polygons.corners) places.push_back(source.gridVertex[v]);
  const auto quads = level1.faces();
  if (source.quadCorners.size() != 4 * quads.size()) return places;
  for (std::size_t q = 0; q < quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k) places[source.quadCorners[4 * q + k]] = quads[q][k];
  return places;
}

std::vector<OtherPlace> otherPlaces(const SourceMesh& source,
                                    const std::vector<Index>& cornerPlaces) {
  std::vector<OtherPlace> others;
  for (std::size_t c = 0; c < cornerPlaces.size(); ++c)
    if (const Index v = source.polygons.corners[c]; cornerPlaces[c] != source.gridVertex[v])
      others.push_back({v, cornerPlaces[c]});
  std::ranges::sort(others);
  const auto same = std::ranges::unique(others);
  others.erase(same.begin(), same.end());
  return others;
}

}  // namespace sweepface
