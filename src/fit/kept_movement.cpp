#include <algorithm>
#include <fmt/format.h>

#include "sweepface/eval.hpp"
#include "sweepface/measure.hpp"

#include "fit/listed.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

std::vector<double> keptMovement(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const std::vector<Vec3> rest = sourcePositions(rig, grid, blend(rig, {}), {});
  const std::vector<Vec3>& neutral = source.neutral.positions;
  std::vector<double> kept(rig.targets.size(), 1);
  parallelFor(std::size_t{0}, kept.size(), [&](std::size_t k) {
    const Weights weights = rig.weightsOf(static_cast<Index>(k) + 1);
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

std::string lostMovement(const MeshRig& source, const std::vector<double>& kept) {
  std::vector<std::pair<std::string, std::string>> lost;
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (kept[k] < 0.5)
      lost.emplace_back(source.targets[k].name,
                        fmt::format(" ({:.0f} % left)", 100 * std::max(kept[k], 0.0)));
  if (lost.empty()) return {};
  return fmt::format("Most of the movement is within the tolerance and lost in {}.", listed(lost));
}

}  // namespace sweepface
