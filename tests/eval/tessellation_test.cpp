#include "sweepface/eval.hpp"

#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class EveryLevel : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Tessellation, EveryLevel, eachFace(), faceName);

TEST_P(EveryLevel, hasTheSourcesShapeWithoutACrack) {
  const Topology source = topologyOf(weldedLoops(GetParam().rig));
  for (int splits : {0, 10}) {
    const Surface surface = surfaceOf(GetParam().rig, splits);
    for (Index level = 1; level <= 8; ++level) {
      const Topology t = topologyOf(loopsOf(Tessellation(surface, level).faces()));
      EXPECT_EQ(t.euler, source.euler) << "level " << level;
      EXPECT_EQ(t.boundaryLoops, source.boundaryLoops) << "level " << level;
      EXPECT_EQ(t.overfullEdges, 0) << "level " << level;
      if (level == 1) {
        EXPECT_EQ(t.vertices, source.vertices);
      }
    }
  }
}

TEST_P(EveryLevel, usesEveryVertex) {
  const Surface surface = surfaceOf(GetParam().rig, 6);
  for (Index level : {1, 3}) {
    const Tessellation t(surface, level);
    std::set<Index> used;
    for (const auto& face : t.faces()) used.insert(face.begin(), face.end());
    EXPECT_EQ(static_cast<Index>(used.size()), t.vertexCount());
    EXPECT_EQ(*used.begin(), 0);
    EXPECT_EQ(*used.rbegin(), t.vertexCount() - 1);
  }
}

TEST_P(EveryLevel, takesVerticesOnArcsFromTheArcBitForBit) {
  const Surface surface = surfaceOf(GetParam().rig, 8);
  const Wireframe& w = surface.wireframe();
  const auto pose = anyPose(surface);
  constexpr Index level = 3;
  const Tessellation t(surface, level);
  const auto positions = t.positions(pose);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int s = 0; s < 4; ++s) {
      Index step = 0;
      for (HalfArc h : w.side(p, s)) {
        const Arc& arc = w.arcs[arcOf(h)];
        const Index m = level * surface.edgesU(p), n = level * surface.edgesV(p);
        for (Index k = 1; k < level * arc.edges; ++k) {
          if (arc.collapsed) continue;
          const Index a = step + k;
          const Index v = s == 0   ? t.vertex(p, a, 0)
                          : s == 1 ? t.vertex(p, m, a)
                          : s == 2 ? t.vertex(p, m - a, n)
                                   : t.vertex(p, 0, n - a);
          const double along = static_cast<double>(h & 1 ? level * arc.edges - k : k) / level;
          EXPECT_EQ(positions[v], surface.pointOnArc(pose, arcOf(h), along));
        }
        step += level * arc.edges;
      }
    }
}

TEST_P(EveryLevel, standsOnTheSurfaceAtItsSites) {
  const Surface surface = surfaceOf(GetParam().rig, 8);
  const auto pose = anyPose(surface);
  const Tessellation t(surface, 2);
  const auto positions = t.positions(pose), normals = t.normals(pose);
  for (Index v = 0; v < t.vertexCount(); ++v) {
    EXPECT_LT(norm(surface.evaluate(pose, t.site(v)) - positions[v]), 1e-12 * largest(pose));
    EXPECT_EQ(normals[v], surface.normal(pose, t.site(v)));
  }
}

TEST_P(EveryLevel, everyPatchPassesThroughItsVertices) {
  const Surface surface = surfaceOf(GetParam().rig, 8);
  const auto pose = anyPose(surface);
  constexpr Index level = 2;
  const Tessellation t(surface, level);
  const auto positions = t.positions(pose);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (Index j = 0; j <= level * surface.edgesV(p); ++j)
      for (Index i = 0; i <= level * surface.edgesU(p); ++i)
        EXPECT_LT(
            norm(surface.evaluate(pose, {p, 0.5 * i, 0.5 * j}) - positions[t.vertex(p, i, j)]),
            1e-12 * largest(pose));
}

TEST_P(EveryLevel, aFinerLevelKeepsTheCoarserVertices) {
  const Surface surface = surfaceOf(GetParam().rig, 4);
  const auto pose = anyPose(surface);
  const Tessellation coarse(surface, 2), fine(surface, 6);
  const auto a = coarse.positions(pose), b = fine.positions(pose);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (Index j = 0; j <= 2 * surface.edgesV(p); ++j)
      for (Index i = 0; i <= 2 * surface.edgesU(p); ++i)
        EXPECT_EQ(a[coarse.vertex(p, i, j)], b[fine.vertex(p, 3 * i, 3 * j)]);
}

TEST(Tessellation, isLinearInThePose) {
  const Surface surface = surfaceOf(everyFace()[5].rig, 6);
  const auto a = anyPose(surface), b = anyPose(surface, 500);
  std::vector<Vec3> mixed(a.size());
  for (std::size_t v = 0; v < a.size(); ++v) mixed[v] = 0.25 * a[v] - 3.0 * b[v];
  const Tessellation t(surface, 4);
  const auto x = t.positions(a), y = t.positions(b), z = t.positions(mixed);
  for (std::size_t v = 0; v < x.size(); ++v)
    EXPECT_LT(norm(z[v] - 0.25 * x[v] + 3.0 * y[v]), 1e-12 * largest(mixed));
}

TEST(Tessellation, numbersFacesPatchByPatchInRows) {
  const Surface surface = Surface::make(twoPatches()).value();
  const Tessellation t(surface, 2);
  const auto faces = t.faces();
  std::size_t face = 0;
  for (Index p = 0; p < 2; ++p)
    for (Index j = 0; j < 2 * surface.edgesV(p); ++j)
      for (Index i = 0; i < 2 * surface.edgesU(p); ++i)
        EXPECT_EQ(faces[face++], (std::array{t.vertex(p, i, j), t.vertex(p, i + 1, j),
                                             t.vertex(p, i + 1, j + 1), t.vertex(p, i, j + 1)}));
  EXPECT_EQ(face, faces.size());
}

TEST(SourceOrder, isThatOfTheSourceWithItsLooseVertices) {
  const Rig rig = dressed(makeRig(twoPatches()));
  const Weights weights{1, 0.5, 0};
  const auto vectors = blend(rig, weights);
  const Tessellation level1(rig.surface, 1);
  const auto grid = level1.positions(vectors), normals = level1.normals(vectors);
  const auto positions = sourcePositions(rig, level1, vectors, weights);
  const auto sourceOrderNormals = sourceNormals(rig, level1, vectors);
  const auto loose = blendLoose(rig, weights);
  ASSERT_EQ(positions.size(), rig.source.gridVertex.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Index g = rig.source.gridVertex[v];
    EXPECT_EQ(positions[v], g >= 0 ? grid[g] : loose[-1 - g]);
    EXPECT_EQ(sourceOrderNormals[v], g >= 0 ? normals[g] : Vec3(0, 0, 1));
  }
}

}  // namespace
}  // namespace sweepface
