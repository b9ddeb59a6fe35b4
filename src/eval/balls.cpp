#include "eval/balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sweepface/box.hpp"

#include "surface/union_find.hpp"

namespace sweepface {
namespace {

constexpr double kRound = 0.05;  // RMS distance from a sphere, relative to its radius

using Equation = std::array<double, 4>;

/// Solves m x = right by elimination; m is a symmetric matrix of sums of squares. Returns nothing
/// if m is singular.
std::optional<Equation> solved(std::array<Equation, 4> m, Equation right) {
  double largest = 0;
  for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, m[k][k]);
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < 4; ++r)
      if (std::abs(m[r][k]) > std::abs(m[pivot][k])) pivot = r;
    if (!(std::abs(m[pivot][k]) > 1e-14 * largest)) return {};
    std::swap(m[k], m[pivot]);
    std::swap(right[k], right[pivot]);
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == k) continue;
      const double factor = m[r][k] / m[k][k];
      for (std::size_t c = k; c < 4; ++c) m[r][c] -= factor * m[k][c];
      right[r] -= factor * right[k];
    }
  }
  for (std::size_t k = 0; k < 4; ++k) right[k] /= m[k][k];
  return right;
}

}  // namespace

std::vector<Part> partsOf(const Tessellation& grid) {
  const Index vertices = grid.vertexCount();
  UnionFind joined(vertices);
  for (const auto& face : grid.faces())
    for (int k = 1; k < 4; ++k) joined.join(face[0], face[k]);
  std::vector<Part> parts(vertices);
  for (Index v = 0; v < vertices; ++v) parts[joined.find(v)].push_back(v);
  std::erase_if(parts, [](const Part& part) { return part.empty(); });
  return parts;
}

/// |p|² = 2 c · p + (r² − |c|²) is linear in c and in the bracket.
std::optional<Ball> ballOf(std::span<const Vec3> points) {
  if (points.size() < 50) return {};
  Vec3 middle;
  for (const Vec3& p : points) middle += p;
  const auto count = static_cast<double>(points.size());
  middle = (1 / count) * middle;
  const Vec3 box = Box(points).size();
  const double size = norm(box);
  if (!(size > 0)) return {};
  std::array<Equation, 4> m{};
  Equation right{};
  for (const Vec3& point : points) {
    const Vec3 p = (1 / size) * (point - middle);
    const Equation row{2 * p.x, 2 * p.y, 2 * p.z, 1};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = 0; c < 4; ++c) m[r][c] += row[r] * row[c];
      right[r] += row[r] * dot(p, p);
    }
  }
  const auto x = solved(m, right);
  if (!x) return {};
  const Vec3 centre{(*x)[0], (*x)[1], (*x)[2]};
  const Ball ball{middle + size * centre,
                  size * std::sqrt(std::max(0.0, (*x)[3] + dot(centre, centre)))};
  double squares = 0;
  for (const Vec3& p : points) {
    const double off = norm(p - ball.centre) - ball.radius;
    squares += off * off;
  }
  // A lens is round too, but not most of a ball.
  if (!(std::sqrt(squares / count) <= kRound * ball.radius) ||
      !(std::min({box.x, box.y, box.z}) > 1.5 * ball.radius))
    return {};
  return ball;
}

}  // namespace sweepface
