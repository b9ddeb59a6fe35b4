#include "fit/corner_places.hpp"

#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// A hill with a fin on its middle column: three quads at each of its edges.
PolygonMesh finned() {
  PolygonMesh mesh = plane();
  constexpr Index kColumns = 11, kFoot = 5, kHigh = 4;
  std::vector<Index> below;
  for (Index j = 0; j <= 8; ++j) below.push_back(kColumns * j + kFoot);
  for (Index h = 1; h <= kHigh; ++h) {
    std::vector<Index> here;
    for (Index j = 0; j <= 8; ++j) {
      here.push_back(static_cast<Index>(mesh.positions.size()));
      const Vec3& foot = mesh.positions[kColumns * j + kFoot];
      mesh.positions.push_back(foot + Vec3{0.3 * std::sin(0.9 * j), 0, 0.5 * h});
    }
    for (std::size_t j = 0; j < 8; ++j)
      addFace(mesh, {below[j], below[j + 1], here[j + 1], here[j]});
    below = here;
  }
  return mesh;
}

/// Reverses the winding of the faces centred on the right, as in a mirrored half.
PolygonMesh halfReversed(const PolygonMesh& mesh) {
  PolygonMesh result;
  result.positions = mesh.positions;
  for (Loop face : loopsOf(mesh.polygons)) {
    double x = 0;
    for (const Index v : face) x += mesh.positions[v].x;
    if (x > 5.0 * static_cast<double>(face.size())) std::ranges::reverse(face);
    addFace(result, face);
  }
  return result;
}

Rig packed(const MeshRig& source, double tolerance, double normalLimit = 0) {
  ConvertOptions options;
  options.pack = true;
  options.tolerance = tolerance;
  options.normalLimit = normalLimit;
  return convert(source, options).value().rig;
}

double furthestCorner(const Rig& rig, const MeshRig& source) {
  const Tessellation grid(rig.surface, 1);
  const auto quads = grid.faces();
  double furthest = 0;
  for (std::size_t k = 0; k <= rig.targets.size(); ++k) {
    Weights weights(rig.targets.size(), 0.0);
    if (k > 0) weights[k - 1] = 1;
    const auto& wanted = k == 0 ? source.neutral.positions : source.targets[k - 1].positions;
    const std::vector<Vec3> found = grid.positions(blend(rig, weights));
    for (std::size_t c = 0; c < 4 * quads.size(); ++c) {
      const Index v = rig.source.polygons.corners[rig.source.quadCorners[c]];
      furthest = std::max(furthest, norm(found[quads[c / 4][c % 4]] - wanted[v]));
    }
  }
  return furthest;
}

class TouchingSheets : public ::testing::TestWithParam<bool> {
 protected:
  const MeshRig source = withTargets(GetParam() ? finned() : halfReversed(plane()));
};
INSTANTIATE_TEST_SUITE_P(CornerPlaces, TouchingSheets, ::testing::Bool());

TEST_P(TouchingSheets, areAllWithinTheTolerance) {
  for (const double tolerance : {0.01, 0.06})
    for (const double limit : {0.0, 180.0}) {
      const Rig rig = packed(source, tolerance, limit);
      EXPECT_FALSE(otherPlaces(rig.source, cornerPlaces(rig.source, {rig.surface, 1})).empty());
      const double furthest = furthestCorner(rig, source);
      EXPECT_LE(furthest, tolerance);
      EXPECT_EQ(furthestVertex(rig, source).distance, furthest);
      EXPECT_EQ(measure(rig, source, {.facets = false})->worst.distance.max, furthest);
    }
}

TEST(CornerPlaces, areWhereTheVerticesAreOnASingleSheet) {
  for (const PolygonMesh& mesh : {plane(), cubeSphere(), cylinder()}) {
    const Rig rig = packed(withTargets(mesh), 0.05);
    EXPECT_TRUE(otherPlaces(rig.source, cornerPlaces(rig.source, {rig.surface, 1})).empty());
  }
}

/// Otherwise they would be the sum over both windings, which lies in the surface.
TEST(CornerPlaces, giveEverySheetNormalsOfItsOwn) {
  const MeshRig whole = withTargets(plane()), reversed = withTargets(halfReversed(plane()));
  EXPECT_LE(normalErrors(packed(reversed, 0.02), reversed).rms,
            3 * normalErrors(packed(whole, 0.02), whole).rms);
}

}  // namespace
}  // namespace sweepface
