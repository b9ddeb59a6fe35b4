#include "sweepface/render_mesh.hpp"

#include "eval/textured.hpp"
#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The triangles as loops of points.
std::vector<Loop> trianglesOf(const RenderMesh& mesh) {
  std::vector<Loop> loops;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    loops.emplace_back();
    for (int c = 0; c < 3; ++c) loops.back().push_back(mesh.pointOf(mesh.triangles[k + c]));
  }
  return loops;
}

double areaOf(const std::vector<Loop>& triangles, const std::vector<Vec3>& places) {
  double area = 0;
  for (const Loop& t : triangles)
    area += 0.5 * norm(cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]));
  return area;
}

class EveryFace : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(RenderMesh, EveryFace, eachFace(), faceName);

TEST_P(EveryFace, HasTheTessellationsShapeAtAnyLevel) {
  Rig rig;
  rig.surface = surfaceOf(GetParam().rig, 6);
  rig.neutral = anyPose(rig.surface);
  rig.neutral.resize(rig.surface.storedCount());
  for (Index level : {1, 2, 3}) {
    const Tessellation grid(rig.surface, level);
    const RenderMesh mesh = renderGrid(rig, grid);
    std::vector<Loop> faces;
    for (const auto& f : grid.faces()) faces.emplace_back(f.begin(), f.end());
    const Topology expected = topologyOf(faces), found = topologyOf(trianglesOf(mesh));
    EXPECT_EQ(found.vertices, expected.vertices);
    EXPECT_EQ(found.euler, expected.euler);
    EXPECT_EQ(found.boundaryLoops, expected.boundaryLoops);
    EXPECT_EQ(found.overfullEdges, 0);
    EXPECT_TRUE(mesh.copies.empty());
    EXPECT_TRUE(mesh.texcoords.empty());
  }
}

TEST(RenderMesh, CutsTheSourcesPolygonsIntoTrianglesOfTheSameArea) {
  const Rig rig = plainSheet();
  const Tessellation grid(rig.surface, 1);
  const RenderMesh mesh = renderSource(rig, grid);
  EXPECT_EQ(mesh.points, 9);
  EXPECT_EQ(mesh.triangles.size(), 3u * 8);
  const auto places = neutralOf(rig, grid);
  EXPECT_NEAR(areaOf(trianglesOf(mesh), places), 4, 1e-12);
  for (const Loop& t : trianglesOf(mesh))  // counter-clockwise
    EXPECT_GT(cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]).z, 0);
}

TEST(RenderMesh, CutsConcavePolygonsInside) {
  Rig rig = plainSheet();
  const Tessellation grid(rig.surface, 1);
  const auto places = neutralOf(rig, grid);
  // Three of the four quads merged into one polygon with seven corners.
  const auto at = [&](double x, double y) {
    return static_cast<Index>(
        std::ranges::find_if(places,
                             [&](const Vec3& p) { return norm(p - Vec3{x, y, 0}) < 1e-9; }) -
        places.begin());
  };
  Polygons& faces = rig.source.polygons = {};
  faces.corners = {at(0, 0), at(2, 0), at(2, 1), at(1, 1), at(1, 2), at(0, 2), at(0, 1)};
  faces.faceStart = {0, 7};
  const RenderMesh mesh = renderSource(rig, grid);
  EXPECT_EQ(mesh.triangles.size(), 3u * 5);
  EXPECT_NEAR(areaOf(trianglesOf(mesh), places), 3, 1e-12);
}

TEST(RenderMesh, CutsQuadsWhereTheyAreShorter) {
  Rig rig = plainSheet();
  for (Index v = 0; v < rig.surface.storedCount(); ++v)  // shear it so that the diagonals differ
    rig.neutral[v].x += 0.5 * rig.neutral[v].y;
  const Tessellation grid(rig.surface, 1);
  const auto longest = [](const RenderMesh& mesh, const std::vector<Vec3>& places) {
    double length = 0;
    for (const Loop& t : trianglesOf(mesh))
      for (int k = 0; k < 3; ++k)
        length = std::max(length, norm(places[t[k]] - places[t[(k + 1) % 3]]));
    return length;
  };
  EXPECT_LT(longest(renderSource(rig, grid), neutralOf(rig, grid)), 1.2);  // not sqrt(13) / 2
  EXPECT_LT(longest(renderGrid(rig, grid), grid.positions(blend(rig, {}))), 1.2);
}

/// The sheet cut into `segments` columns and rows.
Tessellation cut(const Rig& rig, Index segments) {
  return {rig.surface, Density{std::vector<Index>(4, segments), {{segments, segments}}}};
}

/// Texture coordinates equal to the vertices' positions, with a seam along x = 1.
Vec2 withSeam(const Vec3& place, const Vec3& middle) {
  return {place.x + (middle.x > 1 ? 10 : 0), place.y};
}

TEST(RenderMesh, RepeatsPointsOnlyAlongSeams) {
  Rig rig = plainSheet();
  texture(rig, withSeam);
  for (Index level : {0, 1, 3}) {
    const Tessellation grid(rig.surface, std::max(level, 1));
    const RenderMesh mesh = level == 0 ? renderSource(rig, grid) : renderGrid(rig, grid);
    const auto points = level == 0 ? neutralOf(rig, grid) : grid.positions(blend(rig, {}));
    EXPECT_EQ(static_cast<Index>(mesh.copies.size()), 2 * grid.level() + 1) << level;
    ASSERT_EQ(static_cast<Index>(mesh.texcoords.size()), 2 * mesh.vertexCount());
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
      const auto vertex = [&](int c) { return mesh.triangles[k + c]; };
      double middle = 0;
      for (int c = 0; c < 3; ++c) middle += points[mesh.pointOf(vertex(c))].x / 3;
      for (int c = 0; c < 3; ++c) {
        const Vec3& p = points[mesh.pointOf(vertex(c))];
        EXPECT_NEAR(mesh.texcoords[2 * vertex(c)], p.x + (middle > 1 ? 10 : 0), 1e-6);
        EXPECT_NEAR(mesh.texcoords[2 * vertex(c) + 1], p.y, 1e-6);
      }
    }
  }
}

// One column straddles the seam: each of its triangles uses the coordinates of the side that its
// centre lies on.
TEST(RenderMesh, OfADensityGoesOnBeyondSeamsInsidePatches) {
  Rig rig = plainSheet();
  texture(rig, withSeam);
  for (const Index segments : {1, 3, 5}) {
    const Tessellation grid = cut(rig, segments);
    const RenderMesh mesh = renderDensity(rig, grid);
    const auto points = grid.positions(blend(rig, {}));
    ASSERT_EQ(mesh.triangles.size(), 6u * segments * segments);
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
      const auto place = [&](int c) { return points[mesh.pointOf(mesh.triangles[k + c])]; };
      const double middle = (place(0).x + place(1).x + place(2).x) / 3;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(mesh.texcoords[2 * mesh.triangles[k + c]], place(c).x + (middle > 1 ? 10 : 0),
                    1e-6)
            << segments;
        EXPECT_NEAR(mesh.texcoords[2 * mesh.triangles[k + c] + 1], place(c).y, 1e-6);
      }
    }
  }
}

// A slit in the texture along x = 1 from y = 1 to 3, open in the middle. Two triangles cover the
// whole sheet and have the source's own texture coordinates at every corner, as paths lead around
// the ends.
TEST(RenderMesh, OfADensityGoesAroundTheEndsOfSeams) {
  Rig rig = plainSheet(4);
  const auto slit = [](const Vec3& place, const Vec3& middle) {
    const bool gapes = middle.x < 1 && norm(place - Vec3{1, 2, 0}) < 1e-9;
    return Vec2{place.x * place.x - (gapes ? 0.5 : 0), place.y * place.y};
  };
  texture(rig, slit);
  const Tessellation grid = cut(rig, 1);
  const RenderMesh mesh = renderDensity(rig, grid);
  const auto places = grid.positions(blend(rig, {}));
  ASSERT_EQ(mesh.vertexCount(), 4);
  for (std::size_t v = 0; v < 4; ++v) {
    const Vec2 expected = slit(places[v], places[v]);
    EXPECT_NEAR(mesh.texcoords[2 * v], expected.x, 1e-6) << v;
    EXPECT_NEAR(mesh.texcoords[2 * v + 1], expected.y, 1e-6) << v;
  }
}

TEST(RenderMesh, OneCornerAloneMayHaveATextureCoordinate) {
  Rig rig = plainSheet();
  Polygons& faces = rig.source.polygons;
  faces.texcoords = {{0.25, 0.75}};
  faces.cornerTexcoords.assign(faces.corners.size(), -1);
  faces.cornerTexcoords[0] = 0;
  const RenderMesh mesh = renderSource(rig, Tessellation(rig.surface, 1));
  std::vector<float> expected(2 * mesh.points);
  expected[2 * faces.corners[0]] = 0.25f, expected[2 * faces.corners[0] + 1] = 0.75f;
  EXPECT_EQ(mesh.texcoords, expected);
}

// At a pole, every other triangle may have its own texture coordinate.
TEST(RenderMesh, APointMayHaveHundredsOfTextureCoordinates) {
  Rig rig = plainSheet();
  Polygons& faces = rig.source.polygons = {};
  faces.texcoords = {{0, 0}};
  faces.faceStart = {0};
  constexpr int kTriangles = 400;
  for (int k = 0; k < kTriangles; ++k) {
    if (k % 2 == 0) faces.texcoords.push_back({0.25 * k, 1});
    faces.corners.insert(faces.corners.end(), {0, 1, 3});
    faces.cornerTexcoords.insert(faces.cornerTexcoords.end(), {1 + k / 2, 0, 0});
    faces.faceStart.push_back(static_cast<Index>(faces.corners.size()));
  }
  const RenderMesh mesh = renderSource(rig, Tessellation(rig.surface, 1));
  ASSERT_EQ(mesh.triangles.size(), 3u * kTriangles);
  EXPECT_EQ(mesh.copies.size(), kTriangles / 2 - 1u);
  for (int k = 0; k < kTriangles; ++k)
    EXPECT_EQ(mesh.texcoords[2 * mesh.triangles[3 * k]], 0.25f * static_cast<float>(k / 2 * 2));
}

TEST(RenderMesh, KeepsTheTrianglesOfAMaterialTogether) {
  Rig rig = plainSheet();
  rig.source.polygons.materials = {"skin", "lips"};
  rig.source.polygons.faceMaterial = {1, -1, 1, 0};
  const auto parts = [](std::uint32_t each) {
    return std::vector<RenderMesh::Part>{{-1, 0, each}, {0, each, each}, {1, 2 * each, 2 * each}};
  };
  const Tessellation once(rig.surface, 1), twice(rig.surface, 2);
  EXPECT_EQ(renderSource(rig, once).parts, parts(2));
  EXPECT_EQ(renderGrid(rig, once).parts, parts(2));
  EXPECT_EQ(renderGrid(rig, twice).parts, parts(8));
  EXPECT_EQ(renderDensity(rig, cut(rig, 4)).parts, parts(8));
}

TEST(RenderMesh, LeavesOutTrianglesWithoutThreePoints) {
  const Rig rig = makeRig(fan(4));  // its patches are triangles with a collapsed side
  const Tessellation grid(rig.surface, 1);
  for (const RenderMesh& mesh : {renderSource(rig, grid), renderGrid(rig, grid)})
    for (const Loop& t : trianglesOf(mesh)) {
      EXPECT_NE(t[0], t[1]);
      EXPECT_NE(t[1], t[2]);
      EXPECT_NE(t[2], t[0]);
    }
}

TEST(RenderMesh, OfAFileWithoutPolygonsHasNoTriangles) {
  Rig rig = plainSheet();
  rig.source.polygons = {};
  rig.source.quadCorners.clear();
  const Tessellation grid(rig.surface, 1);
  EXPECT_TRUE(renderSource(rig, grid).triangles.empty());
  EXPECT_EQ(renderGrid(rig, grid).triangles.size(), 3u * 8);
}

}  // namespace
}  // namespace sweepface
