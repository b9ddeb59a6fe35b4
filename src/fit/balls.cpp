#include "fit/balls.hpp"

#include <numeric>

namespace sweepface {
namespace {

constexpr double kRound = 0.05;  // RMS distance from a sphere, of its radius

}  // namespace

std::vector<Part> partsOf(const Tessellation& grid) {
  std::vector<Index> parent(grid.vertexCount());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& face : grid.faces())
    for (int k = 1; k < 4; ++k) parent[root(face[k])] = root(face[0]);
  std::vector<Part> parts(parent.size());
  for (Index v = 0; v < grid.vertexCount(); ++v) parts[root(v)].push_back(v);
  std::erase_if(parts, [](const Part& part) { return part.empty(); });
  return parts;
}

/// |p|² = 2 c · p + (r² − |c|²) is linear in c and in what is in brackets.
std::optional<Ball> ballOf(std::span<const Eigen::Vector3d> points) {
  if (points.size() < 50) return {};
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const Eigen::Vector3d origin = points[0];
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point - origin;
    const Eigen::Vector4d row(2 * p.x(), 2 * p.y(), 2 * p.z(), 1);
    m += row * row.transpose();
    right += row * p.squaredNorm();
  }
  const Eigen::Vector4d x = m.ldlt().solve(right);
  Ball ball{x.head<3>() + origin, std::sqrt(std::max(0.0, x[3] + x.head<3>().squaredNorm()))};
  double squares = 0;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) {
    squares += std::pow((p - ball.centre).norm() - ball.radius, 2);
    box.extend(p);
  }
  const double rms = std::sqrt(squares / static_cast<double>(points.size()));
  // A lens is round as well, but it is not most of a ball.
  if (!(rms <= kRound * ball.radius) || !(box.sizes().minCoeff() > 1.5 * ball.radius)) return {};
  return ball;
}

}  // namespace sweepface
