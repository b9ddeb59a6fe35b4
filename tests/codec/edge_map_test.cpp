#include "codec/edge_map.hpp"

#include <gtest/gtest.h>

namespace sweepface::codec {
namespace {

using Map = EdgeMap<Index>;

Index valueIn(const Map& map, Index from, Index to) {
  const Index* const found = map.find(from, to);
  return found ? *found : -1;
}

TEST(EdgeMap, KeepsTheFirstValueOfEveryDirectedEdge) {
  const std::vector<Map::Edge> edges{{2, 0, 10},   {0, 2, 11},  {2, 1, 12},   {2, 0, 13},
                                     {-1, -1, 14}, {-1, 2, 15}, {-1, -1, 16}, {0, -1, 17}};
  const Map map(edges, 3);
  EXPECT_EQ(valueIn(map, 2, 0), 10);
  EXPECT_EQ(valueIn(map, 0, 2), 11);
  EXPECT_EQ(valueIn(map, 2, 1), 12);
  EXPECT_EQ(valueIn(map, -1, -1), 14);
  EXPECT_EQ(valueIn(map, -1, 2), 15);
  EXPECT_EQ(valueIn(map, 0, -1), 17);
  EXPECT_EQ(valueIn(map, 1, 2), -1);
  EXPECT_EQ(valueIn(map, 2, 2), -1);
}

TEST(EdgeMap, IsEmptyWithoutEdges) { EXPECT_EQ(valueIn(Map({}, 1), 0, 0), -1); }

// Square time would take an hour.
TEST(EdgeMap, IsQuickWhereAllEdgesBeginAtOneVertex) {
  constexpr Index kMany = 1'000'000;
  std::vector<Map::Edge> edges;
  for (Index k = 0; k < kMany; ++k) edges.push_back({0, static_cast<Index>(k * 7919ll % kMany), k});
  const Map map(edges, kMany);
  for (const Map::Edge& edge : edges) ASSERT_EQ(valueIn(map, 0, edge.to), edge.value);
}

}  // namespace
}  // namespace sweepface::codec
