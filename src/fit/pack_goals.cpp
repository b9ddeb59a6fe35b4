#include "fit/pack_goals.hpp"

#include "sweepface/eval.hpp"

#include "fit/corner_places.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

PackGoals goalsOf(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const auto poses = static_cast<Index>(rig.targets.size()) + 1;
  const auto count = static_cast<std::size_t>(grid.vertexCount());
  PackGoals goals{std::vector<char>(count), std::vector(poses, std::vector<Vec3>(count))};
  const auto aim = [&](std::size_t vertex, Index place) {
    goals.isKnown[place] = 1;
    const Vec3& neutral = goals.places[0][place] = source.neutral.positions[vertex];
    for (Index pose = 1; pose < poses; ++pose)
      goals.places[pose][place] = source.positionsOf(pose)[vertex] - neutral;
  };
  const auto& where = rig.source.gridVertex;
  for (std::size_t s = 0; s < where.size(); ++s)
    if (where[s] >= 0) aim(s, where[s]);
  for (const auto& [vertex, place] : otherPlaces(rig.source, cornerPlaces(rig.source, grid)))
    aim(static_cast<std::size_t>(vertex), place);
  return goals;
}

PackGoals goalsOf(const Rig& rig) {
  const Tessellation grid(rig.surface, 1);
  PackGoals goals{std::vector<char>(static_cast<std::size_t>(grid.vertexCount()), 1),
                  std::vector<std::vector<Vec3>>(rig.targets.size() + 1)};
  goals.places[0] = grid.positions(blend(rig, {}));
  parallelFor(Index{1}, static_cast<Index>(goals.places.size()), [&](Index pose) {
    goals.places[pose] = grid.positions(blend(rig, rig.weightsOf(pose)));
    for (std::size_t v = 0; v < goals.places[0].size(); ++v)
      goals.places[pose][v] -= goals.places[0][v];
  });
  return goals;
}

}  // namespace sweepface
