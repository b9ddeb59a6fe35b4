#include "codec/edge_map.hpp"

#include <gtest/gtest.h>

namespace sweepface::codec {
namespace {

TEST(EdgeMap, FindsTheFirstOfEveryDirectedEdge) {
  const std::vector<EdgeMap::Edge> edges{{2, 0},   {0, 2},  {2, 1},   {2, 0},
                                         {-1, -1}, {-1, 2}, {-1, -1}, {0, -1}};
  const EdgeMap map(edges, 3);
  EXPECT_EQ(map.find(2, 0), 0);
  EXPECT_EQ(map.find(0, 2), 1);
  EXPECT_EQ(map.find(2, 1), 2);
  EXPECT_EQ(map.find(-1, -1), 4);
  EXPECT_EQ(map.find(-1, 2), 5);
  EXPECT_EQ(map.find(0, -1), 7);
  EXPECT_EQ(map.find(1, 2), -1);
  EXPECT_EQ(map.find(2, 2), -1);
}

TEST(EdgeMap, IsEmptyWithoutEdges) { EXPECT_EQ(EdgeMap({}, 1).find(0, 0), -1); }

// Quadratic time would take an hour.
TEST(EdgeMap, IsQuickWhereAllEdgesBeginAtOneVertex) {
  constexpr Index kMany = 1'000'000;
  std::vector<EdgeMap::Edge> edges;
  for (Index k = 0; k < kMany; ++k) edges.push_back({0, static_cast<Index>(k * 7919ll % kMany)});
  const EdgeMap map(edges, kMany);
  for (Index k = 0; k < kMany; ++k) ASSERT_EQ(map.find(0, edges[k].to), k);
}

}  // namespace
}  // namespace sweepface::codec
