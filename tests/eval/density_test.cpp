#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

#include "sweepface/eval.hpp"
#include "sweepface/evaluator.hpp"

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::vector<Loop> loops(const Tessellation& t) {
  std::vector<Loop> result;
  for (const auto& triangle : t.triangles()) result.emplace_back(triangle.begin(), triangle.end());
  return result;
}

std::vector<Vec3> neutral(const Surface& surface) {
  std::vector<Vec3> vectors(surface.vectorCount());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Index v = 0; v < surface.storedCount(); ++v)
    vectors[v] = {uniform(random), uniform(random), uniform(random)};
  surface.settle({vectors.data(), std::size_t(surface.storedCount())}, vectors);
  return vectors;
}

Density anyDensity(const Surface& surface, unsigned seed) {
  std::mt19937 random(seed);
  Density density;
  for (std::size_t a = 0; a < surface.wireframe().arcs.size(); ++a)
    density.arcs.push_back(1 + static_cast<Index>(random() % 7));
  for (Index p = 0; p < surface.patchCount(); ++p)
    density.patches.push_back(
        {1 + static_cast<Index>(random() % 9), 1 + static_cast<Index>(random() % 9)});
  return density;
}

class EveryDensity : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Tessellation, EveryDensity, eachFace(), faceName);

// An edge between two triangles is one edge: a T-junction would leave a boundary where there is
// none.
TEST_P(EveryDensity, hasTheSourcesShapeWithoutACrackOrATJunction) {
  const Topology source = topologyOf(weldedLoops(GetParam().rig));
  for (const int splits : {0, 10}) {
    const Surface surface = surfaceOf(GetParam().rig, splits);
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Tessellation grid(surface, anyDensity(surface, seed));
      const Topology t = topologyOf(loops(grid));
      EXPECT_EQ(t.euler, source.euler) << "seed " << seed;
      EXPECT_EQ(t.boundaryLoops, source.boundaryLoops) << "seed " << seed;
      EXPECT_EQ(t.overfullEdges, 0) << "seed " << seed;
      EXPECT_EQ(t.vertices, grid.vertexCount()) << "seed " << seed;
    }
  }
}

TEST_P(EveryDensity, numbersItsVerticesTheSameEveryTime) {
  const Surface surface = surfaceOf(GetParam().rig, 3);
  const Tessellation first(surface, anyDensity(surface, 1)), again(surface, anyDensity(surface, 1));
  EXPECT_EQ(first.triangles(), again.triangles());
  const auto vectors = neutral(surface);
  EXPECT_EQ(first.positions(vectors), again.positions(vectors));
}

TEST_P(EveryDensity, liesOnTheSurface) {
  const Surface surface = surfaceOf(GetParam().rig, 3);
  const auto vectors = neutral(surface);
  const Tessellation grid(surface, anyDensity(surface, 2));
  const auto positions = grid.positions(vectors);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (const auto& [vertex, u, v] : grid.patchMesh(p).points)
      EXPECT_LE(norm(positions[vertex] - surface.evaluate(vectors, {p, u.value(), v.value()})),
                1e-9);
}

TEST_P(EveryDensity, keepsABudgetOfVertices) {
  const Surface surface = surfaceOf(GetParam().rig, 0);
  const auto vectors = neutral(surface);
  Index before = 0;
  for (const double most : {20.0, 60.0, 300.0, 3000.0}) {
    const auto density = densityFor(surface, vectors, {Budget::Kind::vertices, most});
    if (!density) {  // it has more corners
      EXPECT_NE(density.error().message.find("vertices at least"), std::string::npos);
      continue;
    }
    const Tessellation grid(surface, *density);
    EXPECT_LE(grid.vertexCount(), most);
    EXPECT_GE(grid.vertexCount(), before);
    before = grid.vertexCount();
  }
  EXPECT_GT(before, 1000);  // it is made use of
}

TEST_P(EveryDensity, hasNoSegmentLongerThanItsBudget) {
  const Surface surface = surfaceOf(GetParam().rig, 2);
  const auto vectors = neutral(surface);
  const double most = 0.4;
  const auto density = densityFor(surface, vectors, {Budget::Kind::edgeLength, most}).value();
  for (std::size_t a = 0; a < density.arcs.size(); ++a) {
    const Arc& arc = surface.wireframe().arcs[a];
    if (arc.collapsed || density.arcs[a] == 64 * arc.edges) continue;
    double length = 0;
    for (int k = 0; k < 32 * arc.edges; ++k)
      length += norm(surface.pointOnArc(vectors, static_cast<Index>(a), (k + 1) / 32.0) -
                     surface.pointOnArc(vectors, static_cast<Index>(a), k / 32.0));
    EXPECT_LE(length / density.arcs[a], 1.05 * most);
  }
}

TEST_P(EveryDensity, hasNoChordFurtherFromItsArcThanItsBudget) {
  const Surface surface = surfaceOf(GetParam().rig, 2);
  const auto vectors = neutral(surface);
  for (const double most : {0.2, 0.05}) {
    const auto density = densityFor(surface, vectors, {Budget::Kind::error, most}).value();
    for (std::size_t a = 0; a < density.arcs.size(); ++a) {
      const Arc& arc = surface.wireframe().arcs[a];
      const Index n = density.arcs[a];
      for (Index k = 0; k < n && !arc.collapsed; ++k) {
        const auto at = [&](double x) {
          return surface.pointOnArc(vectors, static_cast<Index>(a), x * arc.edges / n);
        };
        const Vec3 from = at(k), to = at(k + 1);
        for (const double x : {0.25, 0.5, 0.75}) {
          const Vec3 chord = to - from, off = at(k + x) - from;
          const double t = std::clamp(dot(off, chord) / dot(chord, chord), 0.0, 1.0);
          EXPECT_LE(norm(off - t * chord), 1.3 * most);
        }
      }
    }
  }
}

TEST(Density, refusesABudgetThatIsNone) {
  const Surface surface = Surface::make(onePatch(2, 3)).value();
  const auto vectors = neutral(surface);
  for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_FALSE(densityFor(surface, vectors, {Budget::Kind::error, value}));
  EXPECT_FALSE(densityFor(surface, vectors, {Budget::Kind::vertices, 3}));
}

TEST(Density, refusesMoreVerticesThanAMachineHasRoomFor) {
  const Surface surface = Surface::make(onePatch(200, 200)).value();
  const auto vectors = neutral(surface);
  const auto refused = densityFor(surface, vectors, {Budget::Kind::edgeLength, 1e-6});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("ask for a coarser one"), std::string::npos);
}

TEST(Density, knowsWhatAPixelIs) {
  // 90 degrees: as high as twice the distance.
  EXPECT_NEAR(errorOnScreen(1, 50, 1.5707963267948966, 1000), 0.1, 1e-12);
}

}  // namespace
}  // namespace sweepface
