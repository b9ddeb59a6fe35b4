#include "eval/clusters.hpp"

#include <gtest/gtest.h>
#include <map>
#include <random>

namespace sweepface {
namespace {

/// [clusters] the sizes, after a check that every point is in one of them, in ascending order.
std::vector<std::size_t> sizes(const std::vector<std::vector<Index>>& clusters, std::size_t count) {
  std::vector<std::size_t> list;
  std::vector<int> times(count, 0);
  for (const auto& cluster : clusters) {
    list.push_back(cluster.size());
    EXPECT_TRUE(std::ranges::is_sorted(cluster));
    for (const Index v : cluster) ++times[v];
  }
  EXPECT_EQ(times, std::vector<int>(count, 1));
  return list;
}

/// Places on a grid, many of them with a coordinate in common, as on the middle of a face.
std::vector<Vec3> gridPoints(int n) {
  std::vector<Vec3> points;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) points.push_back({1.0 * i, 1.0 * j, 0});
  return points;
}

TEST(Clusters, areFullButForTheLast) {
  for (const int n : {1, 5, 6, 17, 40}) {
    const auto points = gridPoints(n);
    const auto found = sizes(cluster(points, 32), points.size());
    EXPECT_EQ(found.size(), (points.size() + 31) / 32);
    for (std::size_t k = 0; k + 1 < found.size(); ++k) EXPECT_EQ(found[k], 32u);
  }
  EXPECT_TRUE(cluster({}, 32).empty());
}

TEST(Clusters, keepPointsInOnePlaceTogether) {
  std::mt19937 random(1);
  for (const std::size_t most : {2u, 3u, 8u}) {
    std::vector<Vec3> points = gridPoints(30);
    for (std::size_t v = 0; v < 900; ++v)
      for (std::size_t k = random() % most; k > 0; --k) points.push_back(points[v]);
    std::ranges::shuffle(points, random);
    const auto clusters = cluster(points, 32);
    const auto found = sizes(clusters, points.size());
    EXPECT_LE(std::ranges::max(found), 32u);
    EXPECT_LE(found.size(), (points.size() + 31) / 32 * 4 / 3) << "few more than without";
    std::map<std::pair<double, double>, std::size_t> home;
    for (std::size_t c = 0; c < clusters.size(); ++c)
      for (const Index v : clusters[c])
        EXPECT_EQ(home.emplace(std::pair(points[v].x, points[v].y), c).first->second, c);
  }
}

TEST(Clusters, divideMorePointsInOnePlaceThanTheyHold) {
  const std::vector<Vec3> points(100, Vec3{1, 2, 3});
  EXPECT_EQ(sizes(cluster(points, 32), 100).size(), 4u);
}

}  // namespace
}  // namespace sweepface
