#include "layout/layout.hpp"

#include <random>

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

struct Laid {
  GridMesh mesh;
  Layout layout;
  explicit Laid(const MeshRig& rig)
      : mesh(makeGridMesh(rig).value()), layout(mesh, rig.neutral.positions) {}
  Laid(const Laid&) = delete;
  std::vector<GridPatch> patches() const { return layout.patches().value(); }
};

// Every quad belongs to one patch, as a grid whose columns and rows run straight on.
void expectGrids(const Laid& laid) {
  const auto patches = laid.layout.patches();
  ASSERT_TRUE(patches) << patches.error().message;
  std::vector<int> covered(laid.mesh.quads.size(), 0);
  for (const GridPatch& p : *patches) {
    ASSERT_EQ(p.quads.size(), static_cast<std::size_t>(p.m * p.n));
    ASSERT_EQ(p.vertices.size(), static_cast<std::size_t>((p.m + 1) * (p.n + 1)));
    for (Index j = 0; j < p.n; ++j)
      for (Index i = 0; i < p.m; ++i) {
        const HalfEdge bottom = p.bottoms[j * p.m + i];
        ++covered[p.quads[j * p.m + i]];
        EXPECT_EQ(bottom >> 2, p.quads[j * p.m + i]);
        EXPECT_EQ(laid.mesh.from(bottom), p.vertex(i, j));
        EXPECT_EQ(laid.mesh.to(bottom), p.vertex(i + 1, j));
        EXPECT_EQ(laid.mesh.from(across(bottom)), p.vertex(i + 1, j + 1));
        EXPECT_EQ(laid.mesh.to(across(bottom)), p.vertex(i, j + 1));
      }
  }
  EXPECT_EQ(std::ranges::count(covered, 1), static_cast<std::ptrdiff_t>(covered.size()));
}

void expectSurface(const Laid& laid) {
  auto patches = laid.patches();
  const auto [w, nodeVertices] = laid.layout.wireframe(patches);
  const auto connectivity = Connectivity::make(w);
  ASSERT_TRUE(connectivity) << connectivity.error().message;
  ASSERT_EQ(w.patches.size(), patches.size());
  for (Index p = 0; p < static_cast<Index>(patches.size()); ++p) {
    EXPECT_EQ(w.sideEdges(p, 0), patches[p].m);
    EXPECT_EQ(w.sideEdges(p, 1), patches[p].n);
    EXPECT_EQ(nodeVertices[w.start(w.side(p, 0)[0])], patches[p].vertex(0, 0));
  }
}

class EveryLayout : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Layout, EveryLayout, eachFace(), faceName);

TEST_P(EveryLayout, coversEveryQuadOnceWithGrids) { expectGrids(Laid(GetParam().rig)); }

TEST_P(EveryLayout, hasAWireframeOfItsPatches) { expectSurface(Laid(GetParam().rig)); }

TEST_P(EveryLayout, staysOneWhileItIsSplitAtRandom) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Laid laid(GetParam().rig);
    std::mt19937 random(seed);
    for (int step = 0; step < 12; ++step) {
      const auto patches = laid.patches();
      const GridPatch& p = patches[random() % patches.size()];
      const bool alongV = random() % 2 == 0;
      const Index n = alongV ? p.m : p.n;
      if (n < 2) continue;
      laid.layout.split(p, alongV, 1 + static_cast<Index>(random() % static_cast<unsigned>(n - 1)));
      EXPECT_EQ(laid.patches().size(), patches.size() + 1);
    }
    expectGrids(laid);
    expectSurface(laid);
  }
}

TEST_P(EveryLayout, staysOneWhileItsTNodesRunOn) {
  Laid laid(GetParam().rig);
  std::mt19937 random(7);
  for (int step = 0; step < 8; ++step) {
    const auto patches = laid.patches();
    const GridPatch& p = patches[random() % patches.size()];
    if (p.m > 1) laid.layout.split(p, true, p.m / 2);
  }
  for (Index v = 0; v < laid.mesh.vertexCount(); ++v)
    if (laid.layout.isNode(v) && !laid.layout.isFull(v)) {
      laid.layout.extend(v);
      EXPECT_TRUE(laid.layout.isFull(v));
      expectGrids(laid);
    }
  expectSurface(laid);
}

TEST_P(EveryLayout, coversEveryQuadWhateverIsDamaged) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Laid laid(MeshRig{damaged(GetParam().rig.neutral, seed), {}});
    expectGrids(laid);
    expectSurface(laid);
  }
}

std::size_t patchCount(PolygonMesh mesh) {
  return Laid(MeshRig{std::move(mesh), {}}).patches().size();
}

TEST(Layout, ofAPlaneIsOnePatch) { EXPECT_EQ(patchCount(plane()), 1u); }
TEST(Layout, opensARing) { EXPECT_EQ(patchCount(cylinder()), 1u); }
TEST(Layout, opensAnAnnulus) { EXPECT_EQ(patchCount(annulus()), 1u); }
TEST(Layout, opensATorusTwice) { EXPECT_EQ(patchCount(torus()), 1u); }
TEST(Layout, ofACubeHasItsSixFaces) { EXPECT_EQ(patchCount(cubeSphere()), 6u); }
TEST(Layout, ofAnLCutsFromItsConcaveCorner) {
  const std::size_t count = patchCount(lShape());
  EXPECT_GE(count, 2u);
  EXPECT_LE(count, 3u);
}
TEST(Layout, ofAClosedBandOfQuadsOfOneRowIsOpened) { EXPECT_EQ(patchCount(cylinder(3, 1)), 1u); }
TEST(Layout, ofOneQuadIsOnePatch) { EXPECT_EQ(patchCount(plane(1, 1)), 1u); }

TEST(Layout, doesNotDependOnTheOrderOfTheTargets) {
  MeshRig rig = withTargets(dart(5));
  std::vector<std::size_t> counts{Laid(rig).patches().size()};
  std::ranges::reverse(rig.targets);
  EXPECT_EQ(Laid(rig).patches().size(), counts[0]);
}

TEST(Layout, runsStraightThroughRegularVertices) {
  const Laid laid(MeshRig{plane(4, 4), {}});
  // vertices of the grid mesh in order of its quads; find the middle one by its source
  Index middle = -1;
  for (Index v = 0; v < laid.mesh.vertexCount(); ++v)
    if (laid.mesh.source[laid.mesh.point[v]] == 12) middle = v;
  const auto sourceOf = [&](Index v) { return laid.mesh.source[laid.mesh.point[v]]; };
  for (Index v = 0; v < laid.mesh.vertexCount(); ++v) {
    if (sourceOf(v) == 11) {
      EXPECT_EQ(sourceOf(laid.layout.beyond(middle, v)), 13);
    }
    if (sourceOf(v) == 6) {
      EXPECT_EQ(laid.layout.beyond(middle, v), -1);  // no neighbour
    }
  }
}

}  // namespace
}  // namespace sweepface
