#include <cmath>
#include <numeric>

#include "sweepface/measure.hpp"

#include "fit/corner_places.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

// A distance that is NaN counts as the furthest.
bool isFurther(double distance, const FurthestVertex& known) {
  return !std::isnan(known.distance) && !(distance <= known.distance);
}

void look(FurthestVertex& furthest, double distance, std::size_t vertex) {
  if (isFurther(distance, furthest)) furthest.distance = distance, furthest.vertex = vertex;
}

FurthestVertex furthestIn(const Rig& rig, const Tessellation& grid,
                          const std::vector<OtherPlace>& others, Index pose,
                          const std::vector<Vec3>& source) {
  const Weights weights = rig.weightsOf(pose);
  const std::vector<Vec3> places = grid.positions(blend(rig, weights)),
                          loose = blendLoose(rig, weights);
  FurthestVertex furthest{.target = pose - 1};
  const auto compare = [&](std::size_t v, Index place) {
    look(furthest, norm((place >= 0 ? places[place] : loose[-1 - place]) - source[v]), v);
  };
  for (std::size_t v = 0; v < source.size(); ++v) compare(v, rig.source.gridVertex[v]);
  for (const auto& [vertex, place] : others) compare(static_cast<std::size_t>(vertex), place);
  return furthest;
}

template <typename InPose>
FurthestVertex furthestOf(const Rig& rig, const InPose& inPose) {
  std::vector<FurthestVertex> each(rig.targets.size() + 1);
  parallelFor(Index{0}, static_cast<Index>(each.size()),
              [&](Index pose) { each[pose] = inPose(pose); });
  FurthestVertex furthest = each[0];
  for (const FurthestVertex& f : each)
    if (isFurther(f.distance, furthest)) furthest = f;
  return furthest;
}

}  // namespace

FurthestVertex furthestVertex(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const auto others = otherPlaces(rig.source, cornerPlaces(rig.source, grid));
  return furthestOf(rig, [&](Index pose) {
    return furthestIn(rig, grid, others, pose, source.positionsOf(pose));
  });
}

FurthestVertex furthestVertex(const Rig& rig, const Rig& before) {
  const Tessellation grid(rig.surface, 1);
  std::vector<std::size_t> vertexAt(static_cast<std::size_t>(grid.vertexCount()));
  std::iota(vertexAt.begin(), vertexAt.end(), 0);
  const auto& where = rig.source.gridVertex;
  for (std::size_t s = 0; s < where.size(); ++s)
    if (where[s] >= 0) vertexAt[where[s]] = s;
  return furthestOf(rig, [&](Index pose) {
    const Weights weights = rig.weightsOf(pose);
    const auto places = grid.positions(blend(rig, weights)),
               goals = grid.positions(blend(before, weights));
    FurthestVertex furthest{.target = pose - 1};
    for (std::size_t v = 0; v < places.size(); ++v)
      look(furthest, norm(places[v] - goals[v]), vertexAt[v]);
    const auto loose = blendLoose(rig, weights), looseGoals = blendLoose(before, weights);
    for (std::size_t s = 0; s < where.size(); ++s)
      if (where[s] < 0) look(furthest, norm(loose[-1 - where[s]] - looseGoals[-1 - where[s]]), s);
    return furthest;
  });
}

}  // namespace sweepface
