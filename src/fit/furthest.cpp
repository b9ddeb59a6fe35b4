#include <cmath>

#include "sweepface/measure.hpp"

#include "fit/corner_places.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

FurthestVertex furthestIn(const Rig& rig, const Tessellation& grid,
                          const std::vector<OtherPlace>& others, Index target,
                          const std::vector<Vec3>& source) {
  const Weights weights = rig.weightsOf(target + 1);
  const std::vector<Vec3> places = grid.positions(blend(rig, weights)),
                          loose = blendLoose(rig, weights);
  FurthestVertex furthest{.target = target};
  const auto look = [&](std::size_t v, Index place) {
    const double distance = norm((place >= 0 ? places[place] : loose[-1 - place]) - source[v]);
    // Also true where the distance is not a number, and that is the furthest.
    if (!std::isnan(furthest.distance) && !(distance <= furthest.distance))
      furthest = {distance, v, target};
  };
  for (std::size_t v = 0; v < source.size(); ++v) look(v, rig.source.gridVertex[v]);
  for (const auto& [vertex, place] : others) look(static_cast<std::size_t>(vertex), place);
  return furthest;
}

}  // namespace

FurthestVertex furthestVertex(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const auto others = otherPlaces(rig.source, cornerPlaces(rig.source, grid));
  std::vector<FurthestVertex> each(rig.targets.size() + 1);
  parallelFor(Index{0}, static_cast<Index>(each.size()), [&](Index pose) {
    each[pose] = furthestIn(rig, grid, others, pose - 1, source.positionsOf(pose));
  });
  FurthestVertex furthest = each[0];
  for (const FurthestVertex& f : each)
    if (!std::isnan(furthest.distance) && !(f.distance <= furthest.distance)) furthest = f;
  return furthest;
}

}  // namespace sweepface
