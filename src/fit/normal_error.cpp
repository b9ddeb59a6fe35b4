#include "fit/normal_error.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "sweepface/eval.hpp"

#include "fit/vertex_normals.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

double meanSquare(const Rig& rig, const Tessellation& grid, const Weights& weights,
                  const std::vector<Vec3>& source) {
  const auto expected =
      vertexNormals(rig.source.polygons, source, rig.source.gridVertex, grid.vertexCount());
  const auto found = grid.normals(blend(rig, weights));
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < expected.size(); ++v) {
    if (expected[v] == Vec3{} || found[v] == Vec3{}) continue;
    const double angle = std::atan2(norm(cross(expected[v], found[v])), dot(expected[v], found[v]));
    squares += angle * angle;
    ++count;
  }
  return count > 0 ? squares / static_cast<double>(count) : 0;
}

}  // namespace

double normalRms(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  std::vector<double> squares(rig.targets.size() + 1);
  parallelFor(std::size_t{0}, squares.size(), [&](std::size_t k) {
    Weights weights(rig.targets.size(), 0.0);
    if (k > 0) weights[k - 1] = 1;
    squares[k] = meanSquare(rig, grid, weights,
                            k == 0 ? source.neutral.positions : source.targets[k - 1].positions);
  });
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size())) * 180 / std::numbers::pi;
}

}  // namespace sweepface
