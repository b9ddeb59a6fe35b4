#include "fit/normal_error.hpp"

#include <cmath>

#include "sweepface/eval.hpp"

#include "fit/vertex_normals.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

std::vector<double> anglesIn(const Rig& rig, const Tessellation& grid, const Weights& weights,
                             const std::vector<Vec3>& source) {
  const auto expected =
      vertexNormals(rig.source.polygons, source, rig.source.gridVertex, grid.vertexCount());
  return normalAngles(expected, grid.normals(blend(rig, weights)));
}

}  // namespace

double normalRms(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  std::vector<std::vector<double>> angles(rig.targets.size() + 1);
  parallelFor(std::size_t{0}, angles.size(), [&](std::size_t k) {
    Weights weights(rig.targets.size(), 0.0);
    if (k > 0) weights[k - 1] = 1;
    angles[k] = anglesIn(rig, grid, weights,
                         k == 0 ? source.neutral.positions : source.targets[k - 1].positions);
  });
  double squares = 0;
  std::size_t count = 0;
  for (const std::vector<double>& pose : angles) {
    for (const double angle : pose) squares += angle * angle;
    count += pose.size();
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

}  // namespace sweepface
