#include "sweepface/eval.hpp"
#include "sweepface/measure.hpp"

#include "parallel/parallel.hpp"

namespace sweepface {

std::vector<double> keptMovement(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const std::vector<Vec3> rest = sourcePositions(rig, grid, blend(rig, {}), {});
  const std::vector<Vec3>& neutral = source.neutral.positions;
  std::vector<double> kept(rig.targets.size(), 1);
  parallelFor(std::size_t{0}, kept.size(), [&](std::size_t k) {
    Weights weights(kept.size(), 0.0);
    weights[k] = 1;
    const std::vector<Vec3> moved = sourcePositions(rig, grid, blend(rig, weights), weights);
    double whole = 0, here = 0;
    for (const Index v : source.neutral.polygons.corners) {
      const Vec3 way = source.targets[k].positions[v] - neutral[v];
      whole += dot(way, way);
      here += dot(way, moved[v] - rest[v]);
    }
    if (whole > 0) kept[k] = here / whole;
  });
  return kept;
}

}  // namespace sweepface
