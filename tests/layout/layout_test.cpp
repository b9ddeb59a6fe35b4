#include "layout/layout.hpp"

#include <random>

#include "codec/wireframe_rules.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

struct Laid {
  GridMesh mesh;
  Layout layout;
  explicit Laid(const MeshRig& rig, bool symmetric = false)
      : mesh(makeGridMesh(rig).value()), layout(mesh, rig.neutral.positions, symmetric) {}
  Laid(const Laid&) = delete;
  std::vector<GridPatch> patches() const { return layout.patches().value(); }
  Index sourceOf(Index v) const { return mesh.source[mesh.point[v]]; }
  Index at(Index source) const {  // its last vertex, if a point has several
    for (Index v = mesh.vertexCount(); v-- > 0;)
      if (sourceOf(v) == source) return v;
    return -1;
  }
};

// Every quad belongs to exactly one patch, and patches are grids of straight columns and rows.
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

// Each patch is on the other side of the arc that has waited longest for one, and begins with the
// side that has (where none has, as it was read off the marks), unless a turn shortens ribbons.
void expectGlued(const Wireframe& w, const std::vector<GridPatch>& patches,
                 const std::vector<GridPatch>& asRead) {
  const auto beginsAsRead = [&](const GridPatch& patch) {
    return std::ranges::any_of(
        asRead, [&](const GridPatch& read) { return read.bottoms[0] == patch.bottoms[0]; });
  };
  std::vector<Index> patchOf(2 * w.arcs.size(), -1);
  const auto loopOf = [&](Index p) {
    const auto& sides = w.patches[p].sides;
    return std::span(w.loops).subspan(sides[0], sides[4] - sides[0]);
  };
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (const HalfArc h : loopOf(p)) patchOf[h] = p;
  std::vector<std::size_t> waiting(2 * w.arcs.size(), SIZE_MAX);  // place in the queue
  std::vector<HalfArc> queue;
  std::size_t head = 0;
  codec::SweepRule rule(w);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    while (head < queue.size() && patchOf[queue[head]] < p) ++head;
    EXPECT_EQ(head < queue.size() ? patchOf[queue[head]] : p, p);
    int base = beginsAsRead(patches[p]) ? 0 : 3;
    for (int s = 0; s < 4; ++s)
      if (waiting[w.side(p, s)[0]] < waiting[w.side(p, base)[0]]) base = s;
    EXPECT_TRUE(base == 0 || (base == 3 && rule.turns(p, base)))
        << p << " should begin at " << base;
    rule.sweep(p);
    std::vector<HalfArc> loop(loopOf(p).begin(), loopOf(p).end());
    std::ranges::rotate(loop, loop.begin() + (w.patches[p].sides[base] - w.patches[p].sides[0]));
    for (const HalfArc h : loop) {
      if (patchOf[twin(h)] <= p) continue;
      waiting[twin(h)] = queue.size();
      queue.push_back(twin(h));
    }
  }
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
    EXPECT_EQ(w.arcs[w.side(p, 0)[0] >> 1].collapsed,
              laid.mesh.collapsed[patches[p].bottoms[0]] != 0);
  }
  expectGlued(w, patches, laid.patches());
  // Files store nothing for how patches sweep and which arcs share a ribbon: rules predict both.
  codec::SweepRule rule(w);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    EXPECT_FALSE(rule.turns(p, 0)) << p;
    rule.sweep(p);
  }
  std::vector<Index> ribbons;
  for (const Arc& arc : w.arcs) ribbons.push_back(arc.ribbon);
  EXPECT_EQ(ribbons, codec::expectedRibbons(w));
  std::map<Index, Index> nodePoint;  // by the mesh's point
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    if (w.nodes[n].point >= 0) {
      const auto at = nodePoint.emplace(laid.mesh.point[nodeVertices[n]], w.nodes[n].point).first;
      EXPECT_EQ(at->second, w.nodes[n].point);
    }
  EXPECT_EQ(static_cast<Index>(nodePoint.size()), w.points);
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

TEST(Layout, runsStraightThroughRegularVertices) {
  const Laid laid(MeshRig{plane(4, 4), {}});
  const auto beyond = [&](Index vertex, Index neighbour) {
    const Index v = laid.layout.beyond(laid.at(vertex), laid.at(neighbour));
    return v < 0 ? -1 : laid.sourceOf(v);
  };
  EXPECT_EQ(beyond(12, 11), 13);
  EXPECT_EQ(beyond(12, 6), -1);  // no neighbour
  EXPECT_EQ(beyond(10, 5), 15);
  EXPECT_EQ(beyond(10, 11), -1);  // ends at the boundary
}

TEST(Layout, seesWhereEdgesChangeTheirLength) {
  const PolygonMesh mesh = grid(4, 4, [](double i, double j) { return Vec3{i < 3 ? i : 5, j, 0}; });
  const Laid laid(MeshRig{mesh, {}});
  const auto isUneven = [&](Index v, double ratio) {
    return laid.layout.isUneven(laid.at(v), mesh.positions, ratio);
  };
  EXPECT_TRUE(isUneven(12, 2.9));
  EXPECT_FALSE(isUneven(12, 3.1));
  EXPECT_FALSE(isUneven(11, 1.1));
  std::vector<Vec3> met = mesh.positions;
  for (Index j = 0; j < 5; ++j) met[5 * j + 1] = met[5 * j];
  EXPECT_FALSE(laid.layout.isUneven(laid.at(11), met, 3));  // beside an edge of zero length
}

struct Sheet : Laid {
  Index columns;
  Sheet(Index width, Index height) : Laid(MeshRig{plane(width, height), {}}), columns(width) {}
  /// Cuts all patches of the given width.
  void cut(Index width, bool alongV, Index at) {
    for (const GridPatch& p : patches())
      if (p.m == width) layout.split(p, alongV, at);
  }
  /// Expects a node to store the given numbers of derivatives across and up, position included, and
  /// mixed ones up to second order.
  void expectStored(Index column, Index row, int across, int up) const {
    auto all = patches();
    const auto [w, vertices] = layout.wireframe(all);
    const Index source = row * (columns + 1) + column;
    const auto node = std::ranges::find(vertices, at(source)) - vertices.begin();
    const auto connectivity = Connectivity::make(w).value();
    const Index next = sourceOf(vertices[w.end(connectivity.stars[node].arms[0])]);
    const bool beginsAcross = std::abs(next - source) <= columns;
    const int x = beginsAcross ? across : up, y = beginsAcross ? up : across;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_EQ(w.nodes[node].stored >> (3 * i + j) & 1, i < x && j < y && i + j <= 2)
            << column << ", " << row << ": " << i << ", " << j;
  }
};

/// A sheet cut into four patches at a node, given the number of edges to each side.
struct CutSheet : Sheet {
  CutSheet(Index left, Index right, Index below, Index above) : Sheet(left + right, below + above) {
    layout.split(patches()[0], true, left);
    for (const GridPatch& p : patches()) layout.split(p, false, below);
  }
};

TEST(Layout, storesAtACrossingWhatTheVerticesNearestToItDetermine) {
  CutSheet(1, 1, 1, 1).expectStored(1, 1, 1, 1);
  CutSheet(1, 2, 2, 1).expectStored(1, 2, 1, 1);
  CutSheet(2, 2, 2, 2).expectStored(2, 2, 2, 2);
  CutSheet(2, 3, 3, 3).expectStored(2, 3, 2, 3);
  CutSheet(1, 1, 3, 4).expectStored(1, 3, 1, 3);
  CutSheet(1, 12, 12, 12).expectStored(1, 12, 2, 3);  // one long side does not determine more
}

// A line that ends at another one has no vertex of its own there.
TEST(Layout, storesAtACrossingWhatVerticesUpToAnotherLineDetermine) {
  Sheet sheet(8, 6);
  sheet.cut(8, true, 5);
  sheet.cut(5, false, 3);
  sheet.cut(5, true, 3);
  sheet.expectStored(3, 3, 3, 3);
}

TEST(Layout, storesASlopeAtLeastWhereALineEnds) {
  CutSheet(3, 3, 1, 3).expectStored(3, 0, 3, 2);
  CutSheet(3, 3, 4, 3).expectStored(3, 0, 3, 2);
  CutSheet(3, 3, 5, 3).expectStored(3, 0, 3, 3);
}

// One line runs up 3 from a concave corner, another runs left 4 columns from the other corner.
TEST(Layout, endsALineWhereAnotherHasCrossedAfterAShorterWay) {
  const auto largest = [](double width) {
    const Laid laid(
        MeshRig{only(grid(8, 8, [=](double i, double j) { return Vec3{i * width, j, 0}; }),
                     [=](const Vec3& p) {
                       const double i = p.x / width;
                       return (i > 1.5 || p.y > 1.5) && (i < 6.5 || p.y > 4.5);
                     }),
                {}});
    std::size_t most = 0;
    for (const GridPatch& p : laid.patches()) most = std::max(most, p.quads.size());
    return most;
  };
  EXPECT_EQ(largest(0.8), 12u);
  EXPECT_EQ(largest(0.7), 18u);
}

TEST(Layout, ofAMirroredFaceIsCutOnBothSides) {
  const MeshRig rig{
      grid(12, 5, [](double i, double j) { return Vec3{i - 6, j + i * (12 - i) / 9, j * j / 9}; }),
      {}};
  for (const bool symmetric : {true, false}) {
    Laid laid(rig, symmetric);
    for (Index i = 0; i <= 12; ++i) {
      const Index image = laid.layout.image(laid.at(i));
      EXPECT_EQ(image, symmetric ? laid.at(12 - i) : -1);
    }
    laid.layout.split(laid.patches()[0], true, 3);
    EXPECT_EQ(laid.patches().size(), symmetric ? 3u : 2u);
    expectSurface(laid);
  }
}

}  // namespace
}  // namespace sweepface
