#include "codec/fan_walk.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

#include "codec/level_one.hpp"
#include "codec/mirror.hpp"
#include "codec/rigs.hpp"

namespace sweepface::codec {
namespace {

// A literal implementation of what the header says.
std::vector<Index> naive(Index centre, std::vector<FanWalk::Step> left) {
  std::vector<Index> neighbours;
  const auto meet = [&](Index v) {
    if (v != centre && std::ranges::find(neighbours, v) == neighbours.end())
      neighbours.push_back(v);
  };
  const auto isLedTo = [&](const FanWalk::Step& step) {
    return std::ranges::any_of(left, [&](const auto& other) { return other[1] == step[0]; });
  };
  while (!left.empty()) {
    auto at = std::ranges::find_if_not(left, isLedTo);
    if (at == left.end()) at = left.begin();
    while (at != left.end()) {
      const auto [from, to] = *at;
      left.erase(at);
      meet(from), meet(to);
      at = std::ranges::find_if(left, [&](const auto& step) { return step[0] == to; });
    }
  }
  return neighbours;
}

TEST(FanWalk, GoesAroundAsItSays) {
  std::mt19937 random(1);
  constexpr Index kVertices = 12;
  FanWalk walk(kVertices);
  for (int k = 0; k < 5000; ++k) {
    std::vector<FanWalk::Step> steps(random() % 14);
    std::uniform_int_distribution<Index> any(
        0, std::uniform_int_distribution<Index>(1, kVertices - 1)(random));
    for (auto& step : steps)
      for (Index& v : step) v = any(random);
    const Index centre = k % kVertices;
    std::vector<Index> neighbours;
    walk.around(centre, steps, neighbours);
    EXPECT_EQ(neighbours, naive(centre, steps));
  }
}

// A drawing or a file of a few bytes may have such a pole; a linear search of its corners took
// hours.
TEST(FanWalk, APoleMayHaveTensOfThousandsOfNeighbours) {
  constexpr Index kEdges = 60'000;
  Wireframe wireframe = testing::slice();
  for (Arc& arc : wireframe.arcs) arc.edges = 1;
  const Patch& patch = wireframe.patches[0];
  for (int side = 0; side < 4; ++side)
    if (wireframe.arcs[arcOf(wireframe.loops[patch.sides[side]])].collapsed)
      for (const int s : {side, (side + 2) % 4})
        wireframe.arcs[arcOf(wireframe.loops[patch.sides[s]])].edges = kEdges;
  const Surface surface = Surface::make(wireframe).value();
  const LevelOne grid(surface, spreadMirror(surface.wireframe(), surface.connectivity(), {}));
  const Neighbours vertices = grid.vertexNeighbours(), quads = grid.quadNeighbours();
  EXPECT_EQ(vertices.of(0).size(), static_cast<std::size_t>(kEdges) + 1);
  EXPECT_EQ(quads.items(), static_cast<std::size_t>(kEdges));
}

}  // namespace
}  // namespace sweepface::codec
