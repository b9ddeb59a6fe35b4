#include "sweepface/origins.hpp"

#include <numeric>
#include <set>

#include "sweepface/render_mesh.hpp"

#include "eval/textured.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// An origin's position, interpolated from the source vertices around it.
Vec3 mixed(const Origin& origin, const std::vector<Vec3>& source) {
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum += origin.shares[k] * source[origin.vertices[k]];
  return sum;
}

void expectSound(const std::vector<Origin>& origins, Index sourceVertices) {
  for (const auto& [vertices, shares] : origins) {
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-14);
    const auto count = std::ranges::find(shares, 0.0) - shares.begin();
    std::set<Index> counted(vertices.begin(), vertices.begin() + count);
    EXPECT_EQ(std::ssize(counted), count) << "none twice";
    EXPECT_TRUE(*counted.begin() >= 0 && *counted.rbegin() < sourceVertices);
    for (int k = 0; k < 4; ++k) {
      EXPECT_TRUE(k < count ? shares[k] > 0 : shares[k] == 0);
      EXPECT_TRUE(k < count || vertices[k] == vertices[0]);
    }
  }
}

TEST(Origins, LieOnTheSourcesQuads) {
  const Rig rig = plainSheet(3);  // flat, with edges of equal length
  const auto source = neutralOf(rig, Tessellation(rig.surface, 1));
  for (const Index level : {1, 2, 5}) {
    const Tessellation grid(rig.surface, level);
    const auto origins = originsOf(rig, grid).value();
    const auto positions = grid.positions(blend(rig, {}));
    ASSERT_EQ(origins.size(), positions.size());
    expectSound(origins, 16);
    for (std::size_t v = 0; v < origins.size(); ++v) {
      EXPECT_LE(norm(mixed(origins[v], source) - positions[v]), 1e-12);
      EXPECT_TRUE(level > 1 || origins[v].shares[0] == 1);
    }
  }
}

TEST(Origins, OfBudgetsLieThereToo) {
  const Rig rig = plainSheet(3);
  const auto source = neutralOf(rig, Tessellation(rig.surface, 1)), vectors = blend(rig, {});
  for (const double length : {0.3, 0.7, 2.0}) {
    const auto density = densityFor(rig.surface, vectors, {Budget::Kind::edgeLength, length});
    const Tessellation grid(rig.surface, *density);
    const auto origins = originsOf(rig, grid).value();
    const auto positions = grid.positions(vectors);
    expectSound(origins, 16);
    for (std::size_t v = 0; v < origins.size(); ++v)
      EXPECT_LE(norm(mixed(origins[v], source) - positions[v]), 1e-12) << length;
  }
}

TEST(Origins, OfSingleSitesLieThereToo) {
  const Rig rig = plainSheet(3);
  const auto source = neutralOf(rig, Tessellation(rig.surface, 1));
  const Tessellation sites(
      rig.surface,
      std::vector<Site>{{0, 0, 0}, {0, 0.25, 1.5}, {0, 2, 2.75}, {0, 3, 3}, {0, 3, 1}});
  const auto origins = originsOf(rig, sites).value();
  const auto positions = sites.positions(blend(rig, {}));
  ASSERT_EQ(origins.size(), 5u);
  expectSound(origins, 16);
  for (std::size_t v = 0; v < origins.size(); ++v)
    EXPECT_LE(norm(mixed(origins[v], source) - positions[v]), 1e-12);
}

// Attributes are interpolated bilinearly on every quad, even at poles and hanging nodes.
TEST(Origins, MixWhatHangsOnVerticesAsTextureCoordinatesAre) {
  for (Rig rig : {makeRig(onePatch(3, 2)), makeRig(tee()), makeRig(slice()), makeRig(fan(4))}) {
    std::iota(rig.source.quadCorners.begin(), rig.source.quadCorners.end(), 0);
    texture(rig, [](const Vec3& p, const Vec3&) { return Vec2{p.x, p.y}; });
    const auto source = neutralOf(rig, Tessellation(rig.surface, 1));
    const Tessellation grid(rig.surface, 4);
    const auto origins = originsOf(rig, grid).value();
    const RenderMesh mesh = renderGrid(rig, grid);
    expectSound(origins, static_cast<Index>(source.size()));
    for (std::size_t v = 0; v < origins.size(); ++v) {
      const Vec3 place = mixed(origins[v], source);
      EXPECT_NEAR(place.x, mesh.texcoords[2 * v], 1e-5) << v;
      EXPECT_NEAR(place.y, mesh.texcoords[2 * v + 1], 1e-5) << v;
    }
  }
}

TEST(Origins, NeedTheSourcesVertices) {
  Rig rig = plainSheet();
  rig.source = {};
  EXPECT_FALSE(originsOf(rig, Tessellation(rig.surface, 2)));
}

}  // namespace
}  // namespace sweepface
