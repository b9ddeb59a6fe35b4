#include <algorithm>
#include <cmath>

#include "sweepface/eval.hpp"
#include "sweepface/measure.hpp"

#include "fit/corner_places.hpp"
#include "fit/vertex_normals.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

std::vector<double> anglesIn(const Rig& rig, const Tessellation& grid, const Weights& weights,
                             const std::vector<Index>& places, const std::vector<Vec3>& source) {
  const auto expected = vertexNormals(rig.source.polygons, source, places, grid.vertexCount(),
                                      rig.source.quadCorners);
  return normalAngles(expected, grid.normals(blend(rig, weights)));
}

}  // namespace

NormalErrors normalErrors(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const std::vector<Index> places = cornerPlaces(rig.source, grid);
  std::vector<std::vector<double>> angles(rig.targets.size() + 1);
  parallelFor(Index{0}, static_cast<Index>(angles.size()), [&](Index pose) {
    angles[pose] = anglesIn(rig, grid, rig.weightsOf(pose), places, source.positionsOf(pose));
  });
  double squares = 0, largest = 0;
  std::size_t count = 0;
  for (const std::vector<double>& pose : angles) {
    for (const double angle : pose) squares += angle * angle, largest = std::max(largest, angle);
    count += pose.size();
  }
  return {count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0, largest};
}

}  // namespace sweepface
