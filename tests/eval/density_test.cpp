#include <gtest/gtest.h>
#include <map>
#include <random>

#include "sweepface/eval.hpp"
#include "sweepface/evaluator.hpp"

#include "eval/stitching.hpp"
#include "surface/distances.hpp"
#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

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

/// One segment everywhere, as parts that a budget does not constrain may get.
Density coarsest(const Surface& surface) {
  return {std::vector<Index>(surface.wireframe().arcs.size(), 1),
          std::vector(surface.patchCount(), std::array{1, 1})};
}

class EveryDensity : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Tessellation, EveryDensity, eachFace(), faceName);

// Neighbouring triangles share their edges: a T-junction would show up as an extra boundary.
TEST_P(EveryDensity, hasTheSourcesShapeWithoutACrackOrATJunction) {
  const Topology source = topologyOf(weldedLoops(GetParam().rig));
  for (const int splits : {0, 10}) {
    const Surface surface = surfaceOf(GetParam().rig, splits);
    for (unsigned seed = 0; seed < 6; ++seed) {
      const Tessellation grid(surface, seed == 0 ? coarsest(surface) : anyDensity(surface, seed));
      const Topology t = topologyOf(loopsOf(grid.triangles()));
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
    if (!density) continue;  // the budget is below the number of corners
    const Tessellation grid(surface, *density);
    EXPECT_LE(grid.vertexCount(), most);
    EXPECT_GE(grid.vertexCount(), before);
    before = grid.vertexCount();
  }
  EXPECT_GT(before, 1000);  // the budget is actually used
}

TEST_P(EveryDensity, refusesFewerVerticesThanItHasAndSaysHowManyDo) {
  const Surface surface = surfaceOf(GetParam().rig, 0);
  const auto vectors = neutral(surface);
  const auto refused = densityFor(surface, vectors, {Budget::Kind::vertices, 1});
  ASSERT_FALSE(refused);
  double enough = 0;
  ASSERT_EQ(
      std::sscanf(refused.error().message.c_str(), "The face has %lf vertices at least", &enough),
      1);
  for (const double most : {enough, enough + 1, enough + 2})
    EXPECT_TRUE(densityFor(surface, vectors, {Budget::Kind::vertices, most})) << most;
}

/// The largest value of `segment`, which measures a curve over [0, 1], among the segments of all
/// arcs. Arcs already at the maximum density are left out.
double worstSegment(const Surface& surface, std::span<const Vec3> vectors, const Density& density,
                    const auto& segment) {
  double worst = 0;
  for (Index a = 0; a < std::ssize(density.arcs); ++a) {
    const Arc& arc = surface.wireframe().arcs[a];
    const Index n = density.arcs[a];
    if (arc.collapsed || n == 64 * arc.edges) continue;
    for (Index k = 0; k < n; ++k)
      worst = std::max(worst, segment([&](double x) {
                         return surface.pointOnArc(vectors, a, (k + x) * arc.edges / n);
                       }));
  }
  return worst;
}

TEST_P(EveryDensity, hasNoSegmentLongerThanItsBudget) {
  const Surface surface = surfaceOf(GetParam().rig, 2);
  const auto vectors = neutral(surface);
  for (const double most : {1.0, 0.4, 0.1}) {
    const auto density = densityFor(surface, vectors, {Budget::Kind::edgeLength, most}).value();
    EXPECT_LE(
        worstSegment(surface, vectors, density, [](const auto& at) { return norm(at(1) - at(0)); }),
        (1 + 1e-12) * most);
  }
}

TEST_P(EveryDensity, hasNoChordFurtherFromItsArcThanItsBudget) {
  const Surface surface = surfaceOf(GetParam().rig, 2);
  const auto vectors = neutral(surface);
  for (const double most : {0.2, 0.05, 0.002}) {
    const auto density = densityFor(surface, vectors, {Budget::Kind::error, most}).value();
    EXPECT_LE(worstSegment(surface, vectors, density,
                           [](const auto& at) {
                             double sag = 0;
                             for (int k = 1; k < 50; ++k)
                               sag = std::max(sag, distanceToSegment(at(k / 50.0), at(0), at(1)));
                             return sag;
                           }),
              1.1 * most);
  }
}

/// The largest distance between a patch and its triangles, sampled at three points inside each.
/// Triangles at a collapsed side, whose single vertex has no unique parameters, are left out.
double worstTriangle(const Surface& surface, std::span<const Vec3> vectors,
                     const Tessellation& grid, Index patch) {
  const auto positions = grid.positions(vectors);
  const PatchMesh mesh = grid.patchMesh(patch);
  std::map<Index, int> uses;
  for (const auto& point : mesh.points) ++uses[point.vertex];
  double worst = 0;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> at;
    std::array<Vec2, 3> place;
    bool isPole = false;
    for (int k = 0; k < 3; ++k) {
      const auto& [vertex, u, v] = mesh.points[triangle[k]];
      at[k] = positions[vertex], place[k] = {u.value(), v.value()};
      isPole |= uses[vertex] > 2;
    }
    for (int k = 0; k < 3 && !isPole; ++k) {
      const Vec2 &a = place[k], &b = place[(k + 1) % 3], &c = place[(k + 2) % 3];
      const Site site{patch, (2 * a.x + b.x + c.x) / 4, (2 * a.y + b.y + c.y) / 4};
      const Vec3 on = surface.evaluate(vectors, site);
      worst = std::max(worst, distanceToTriangle(on, at[0], at[1], at[2]));
    }
  }
  return worst;
}

TEST_P(EveryDensity, hasNoTriangleMuchFurtherFromTheSurfaceThanItsBudget) {
  const Surface surface = surfaceOf(GetParam().rig, 2);
  const auto vectors = neutral(surface);
  for (const double most : {0.2, 0.05, 0.01}) {
    const auto density = densityFor(surface, vectors, {Budget::Kind::error, most}).value();
    const Tessellation grid(surface, density);
    for (Index p = 0; p < surface.patchCount(); ++p) {
      const auto [columns, rows] = density.patches[p];
      if (columns == 64 * surface.edgesU(p) || rows == 64 * surface.edgesV(p)) continue;
      EXPECT_LE(worstTriangle(surface, vectors, grid, p), 1.5 * most) << "patch " << p;
    }
  }
}

// Errors fall with the square of the number of cuts, so the vertex count is proportional to
// 1 / error. It would be larger if a collapsed side had a length, or if lines used up the whole
// error.
TEST(Density, takesFewVerticesWhicheverSideIsAPoint) {
  for (std::ptrdiff_t turn = 0; turn < 4; ++turn) {
    Wireframe turned = slice();
    std::rotate(turned.loops.begin(), turned.loops.begin() + turn, turned.loops.end());
    const Surface surface = Surface::make(turned).value();
    for (const double error : {0.05, 0.002}) {
      const auto density =
          densityFor(surface, neutral(surface), {Budget::Kind::error, error}).value();
      EXPECT_LT(Tessellation(surface, density).vertexCount() * error, 8) << turn;
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

TEST(Density, refusesABudgetOfMoreVerticesThanAMeshMayHave) {
  const Surface surface = Surface::make(onePatch(2, 3)).value();
  const auto refused = densityFor(surface, neutral(surface), {Budget::Kind::vertices, 1e9});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "A mesh has at most 16777216 vertices; ask for no more.");
}

TEST(Density, makesUseOfABudgetOnCurvesOfManyEdges) {
  const Surface surface = Surface::make(onePatch(4000, 2)).value();
  const auto density =
      densityFor(surface, neutral(surface), {Budget::Kind::vertices, 20000}).value();
  EXPECT_GT(Tessellation(surface, density).vertexCount(), 10000);
}

TEST(Density, takesNoErrorForLessThanABillionthOfTheLongestCurve) {
  const Surface surface = Surface::make(onePatch(2000, 20)).value();
  const auto vectors = neutral(surface);
  const auto refusal = [&](double error) {  // the message gives the number of vertices needed
    const auto density = densityFor(surface, vectors, {Budget::Kind::error, error});
    return density ? "none" : density.error().message;
  };
  EXPECT_EQ(refusal(1e-300), refusal(1e-10));
  EXPECT_NE(refusal(1e-300), refusal(100));
}

TEST(Density, cutsNoFurtherAcrossWhereAnEdgeIsAsFineAsItMayBe) {
  const Surface surface = Surface::make(onePatch(600, 1)).value();
  const auto density = densityFor(surface, neutral(surface), {Budget::Kind::error, 1e-4}).value();
  EXPECT_EQ(density.patches[0][1], 64);
  EXPECT_LT(density.patches[0][0], 64 * 600);
}

TEST(Density, cutsPatchesOfMoreEdgesThanAMeshHasVertices) {
  const Surface surface = Surface::make(onePatch(kMostVertices + 1, 1)).value();
  const auto density = densityFor(surface, neutral(surface), {Budget::Kind::error, 1e5});
  ASSERT_TRUE(density) << density.error().message;
  EXPECT_GT(density->patches[0][0], 3);
}

TEST(Density, knowsWhatAPixelIs) {
  // At 90 degrees the view is twice as high as the distance.
  EXPECT_NEAR(errorOnScreen(1, 50, 1.5707963267948966, 1000), 0.1, 1e-12);
}

}  // namespace
}  // namespace sweepface
