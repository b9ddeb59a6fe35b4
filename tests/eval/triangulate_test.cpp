#include "eval/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace sweepface {
namespace {

double signedArea(std::span<const Vec3> polygon, const Triangle& t) {
  return 0.5 * cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]).z;
}

/// Expects the triangles to cover a planar polygon: none is flipped, and their areas add up to its.
void expectCovers(const std::vector<Vec3>& polygon) {
  const std::vector<Triangle> triangles = triangulate(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  double whole = 0, sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    whole += 0.5 * cross(polygon[k], polygon[(k + 1) % polygon.size()]).z;
  for (const Triangle& t : triangles) {
    EXPECT_GT(signedArea(polygon, t), 0);
    sum += signedArea(polygon, t);
  }
  EXPECT_NEAR(sum, whole, 1e-11);
}

TEST(Triangulate, CutsAQuadAlongItsShorterDiagonal) {
  const std::vector<Vec3> wide{{0, 0, 0}, {3, 1, 0}, {3, 2, 0}, {0, 1, 0}};
  const auto triangles = triangulate(wide);
  ASSERT_EQ(triangles.size(), 2u);
  for (const Triangle& t : triangles) {
    EXPECT_TRUE(std::ranges::count(t, 1) == 1 && std::ranges::count(t, 3) == 1);
    EXPECT_GT(signedArea(wide, t), 0);
  }
}

TEST(Triangulate, KeepsInsideConcavePolygons) {
  expectCovers({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}});
  expectCovers({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0.5, 0}, {0, 4, 0}});
  expectCovers(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 2, 0}, {2, 2, 0}, {2, 1, 0}, {0, 1, 0}});
  // The corners (-1, 4) and (-6, -3) are ears only until an adjacent corner is cut off.
  expectCovers({{8, 0, 0}, {1, 2, 0}, {-1, 4, 0}, {-4, 2, 0}, {-6, -3, 0}, {0, -1, 0}, {1, -2, 0}});
}

TEST(Triangulate, LeavesNoSliverWhereACornerIsStraight) {
  expectCovers({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}});
  expectCovers({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
}

TEST(Triangulate, CutsStars) {
  for (const int corners : {24, 66, 512}) {
    std::vector<Vec3> star;
    for (int k = 0; k < corners; ++k) {
      const double a = 2 * std::numbers::pi * k / corners, r = k % 2 ? 1 : 3;
      star.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
    expectCovers(star);
  }
}

/// For any polygon, each of its edges belongs to exactly one triangle.
TEST(Triangulate, CoversTwistedAndHugePolygonsOnce) {
  std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, flat(5, Vec3{1, 2, 3}), ring;
  for (int k = 0; k < 1000; ++k)
    ring.push_back(
        {std::cos(0.002 * std::numbers::pi * k), std::sin(0.002 * std::numbers::pi * k), 0});
  for (const auto& polygon : {bow, flat, ring}) {
    const auto n = static_cast<Index>(polygon.size());
    std::multiset<std::pair<Index, Index>> edges;
    for (const Triangle& t : triangulate(polygon))
      for (int k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
    EXPECT_EQ(edges.size(), 3 * polygon.size() - 6);
    for (Index k = 0; k < n; ++k) EXPECT_EQ(edges.count({k, (k + 1) % n}), 1u);
    for (const auto& [a, b] : edges) EXPECT_EQ(edges.count({b, a}), (a + 1) % n == b ? 0u : 1u);
  }
}

TEST(Triangulate, LeavesATriangleAsItIs) {
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(triangulate(triangle), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(triangulate(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).empty());
}

}  // namespace
}  // namespace sweepface
