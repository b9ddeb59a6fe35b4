#include "sweepface/nearest.hpp"

#include <limits>
#include <random>

#include "sweepface/box.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "eval/play.hpp"
#include "eval/textured.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class Anywhere {
 public:
  explicit Anywhere(unsigned seed) : random_(seed) {}
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 point(const Box& box) {
    return {number(box.low.x, box.high.x), number(box.low.y, box.high.y),
            number(box.low.z, box.high.z)};
  }
  Site site(const Surface& surface) {
    const Index p = std::uniform_int_distribution<Index>(0, surface.patchCount() - 1)(random_);
    return {p, number(0, surface.edgesU(p)), number(0, surface.edgesV(p))};
  }

 private:
  std::mt19937 random_;
};

/// Smooth surfaces, open and closed, with poles, irregular nodes and patches that meet themselves.
const std::vector<Rig>& smoothRigs() {
  static const std::vector<Rig> rigs = [] {
    ConvertOptions options;
    options.tolerance = 0.05;
    options.normalLimit = 180;  // large patches
    options.chooseShapes = false;
    std::vector<Rig> list;
    for (const MeshRig& mesh :
         {withTargets(cubeSphere(4)), withTargets(uvSphere(8, 6)), withTargets(uvSphere(24, 16)),
          withTargets(pinwheel(5, 3)), withTargets(cylinder()), withTargets(torus())})
      list.push_back(convert(mesh, options).value().rig);
    list.push_back(plainSheet(4));
    return list;
  }();
  return rigs;
}

std::vector<Vec3> pointsAround(std::span<const Vec3> positions, int count) {
  Box box(positions);
  const double around = 0.3 * norm(box.size());
  const Vec3 margin{around, around, around};
  box.low -= margin, box.high += margin;
  Anywhere anywhere(3);
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) points.push_back(anywhere.point(box));
  return points;
}

double distanceTo(std::span<const Vec3> positions, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : positions) least = std::min(least, norm(p - point));
  return least;
}

bool isInside(const Surface& surface, const Site& site) {
  return site.patch >= 0 && site.patch < surface.patchCount() && site.u >= 0 && site.v >= 0 &&
         site.u <= surface.edgesU(site.patch) && site.v <= surface.edgesV(site.patch);
}

/// Points of the neutral's surface are their own nearest.
void expectThere(const Rig& rig, const std::vector<Vec3>& points) {
  const auto vectors = blend(rig, {});
  const double size = diagonal(Tessellation(rig.surface, 1).positions(vectors));
  const auto sites = nearestSites(rig.surface, vectors, points).value();
  for (std::size_t k = 0; k < sites.size(); ++k)
    EXPECT_LE(norm(rig.surface.evaluate(vectors, sites[k]) - points[k]), 1e-9 * size) << k;
}

TEST(NearestSites, AreNoFurtherThanAnythingElseOnTheSurface) {
  for (const Rig& rig : smoothRigs()) {
    const auto vectors = blend(rig, {});
    const auto fine = Tessellation(rig.surface, 24).positions(vectors);
    const auto points = pointsAround(fine, 300);
    const auto sites = nearestSites(rig.surface, vectors, points).value();
    ASSERT_EQ(sites.size(), points.size());
    for (std::size_t k = 0; k < sites.size(); ++k) {
      ASSERT_TRUE(isInside(rig.surface, sites[k]));
      const double found = norm(rig.surface.evaluate(vectors, sites[k]) - points[k]);
      EXPECT_LE(found, distanceTo(fine, points[k]) * (1 + 1e-12)) << k;
    }
  }
}

// Surfaces that bulge more than any converted from a mesh.
TEST(NearestSites, AreNoFurtherThanPointsAtHalfEdgesWhateverTheSurface) {
  for (const Rig& rig : someRigs()) {
    const auto vectors = blend(rig, {});
    const auto samples = Tessellation(rig.surface, 2).positions(vectors);
    const auto points = pointsAround(samples, 100);
    const auto sites = nearestSites(rig.surface, vectors, points).value();
    for (std::size_t k = 0; k < sites.size(); ++k) {
      ASSERT_TRUE(isInside(rig.surface, sites[k]));
      const double found = norm(rig.surface.evaluate(vectors, sites[k]) - points[k]);
      EXPECT_LE(found, distanceTo(samples, points[k]) * (1 + 1e-9));
    }
  }
}

TEST(NearestSites, OfPointsOnTheSurfaceAreThere) {
  Anywhere anywhere(5);
  for (const Rig& rig : smoothRigs()) {
    const auto vectors = blend(rig, {});
    std::vector<Vec3> points;
    for (int k = 0; k < 300; ++k)
      points.push_back(rig.surface.evaluate(vectors, anywhere.site(rig.surface)));
    expectThere(rig, points);
  }
}

// Poles are collapsed sides.
TEST(NearestSites, OfPointsBesideSidesOfPatchesAreThere) {
  Anywhere anywhere(9);
  for (const Rig& rig : smoothRigs()) {
    const auto vectors = blend(rig, {});
    std::vector<Vec3> points;
    for (int k = 0; k < 2000; ++k) {
      Site site = anywhere.site(rig.surface);
      const double length[] = {static_cast<double>(rig.surface.edgesU(site.patch)),
                               static_cast<double>(rig.surface.edgesV(site.patch))};
      double& across = k % 2 ? site.u : site.v;
      across = std::min(anywhere.number(0, 0.6), length[k % 2 ? 0 : 1]);
      if (k % 4 < 2) across = length[k % 2 ? 0 : 1] - across;
      points.push_back(rig.surface.evaluate(vectors, site));
    }
    expectThere(rig, points);
  }
}

TEST(NearestSites, SeePointsAlongTheNormal) {
  int inside = 0;
  for (const Rig& rig : smoothRigs()) {
    const auto vectors = blend(rig, {});
    const auto points = pointsAround(Tessellation(rig.surface, 1).positions(vectors), 100);
    const auto sites = nearestSites(rig.surface, vectors, points).value();
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const auto& [patch, u, v] = sites[k];
      if (u <= 0 || v <= 0 || u >= rig.surface.edgesU(patch) || v >= rig.surface.edgesV(patch))
        continue;
      const Vec3 way = normalized(points[k] - rig.surface.evaluate(vectors, sites[k]));
      EXPECT_LE(norm(cross(way, rig.surface.normal(vectors, sites[k]))), 1e-6);
      ++inside;
    }
  }
  EXPECT_GE(inside, 100);
}

TEST(NearestSites, AreRefusedWhereThereAreNone) {
  const Rig rig = plainSheet();
  const auto vectors = blend(rig, {});
  for (const double wrong : {std::nan(""), HUGE_VAL, -1e101}) {
    const Vec3 points[] = {{0, 0, 0}, {0, wrong, 0}};
    const auto sites = nearestSites(rig.surface, vectors, points);
    ASSERT_FALSE(sites);
    EXPECT_EQ(sites.error().message, "Point 1 must have coordinates within 1e100 of 0.");
  }
  const Vec3 far[] = {{1e6, 1e6, 0}, {1e100, 1e100, -1e100}};
  const auto sites = nearestSites(rig.surface, vectors, far).value();
  EXPECT_LE(norm(rig.surface.evaluate(vectors, sites[0]) - Vec3{2, 2, 0}), 1e-9);
  EXPECT_TRUE(isInside(rig.surface, sites[1]));
  EXPECT_FALSE(nearestSites(Surface::make({}).value(), {}, far));
}

TEST(TessellationsOfSites, ArePlayedAsTheSurfaceMoves) {
  Anywhere anywhere(7);
  for (const Rig& rig : smoothRigs()) {
    std::vector<Site> sites;
    for (int k = 0; k < 100; ++k) sites.push_back(anywhere.site(rig.surface));
    const Tessellation grid(rig.surface, sites);
    EXPECT_TRUE(grid.isOfSites());
    EXPECT_FALSE(Tessellation(rig.surface, 1).isOfSites());
    const auto evaluator = Evaluator::make(rig, grid, {.level = 1}).value();
    const std::vector<double> weights(rig.targets.size(), 0.4);
    const auto vectors = blend(rig, weights);
    const Played played = play(evaluator, weights);
    ASSERT_EQ(played.positions.size(), 3 * sites.size());
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const Vec3 place = rig.surface.evaluate(vectors, sites[k]);
      EXPECT_LE(norm(vectorOf(played.positions, k) - place), evaluator.positionBound(weights));
      EXPECT_LE(norm(grid.positions(vectors)[k] - place), 1e-12);
      const Vec3 normal = rig.surface.normal(vectors, sites[k]),
                 along = normalized(rig.surface.evaluate(vectors, sites[k], 1, 0));
      EXPECT_GE(dot(vectorOf(played.normals, k), normal), 0.99);
      EXPECT_GE(dot(vectorOf(played.tangents, k), along), 0.99);
    }
  }
}

// The bounding box of a single point cannot supply the default tolerance.
TEST(TessellationsOfSites, AreAsExactWhereTheRigHasNoTolerance) {
  Rig rig = smoothRigs().front();
  rig.tolerance = 0;
  const Site site{0, 0.4, 0.3};
  const Tessellation grid(rig.surface, std::vector<Site>{site});
  const auto evaluator = Evaluator::make(rig, grid, {.level = 1}).value();
  const std::vector<double> weights(rig.targets.size(), 0.4);
  const auto vectors = blend(rig, weights);
  const Played played = play(evaluator, weights);
  EXPECT_LE(norm(vectorOf(played.positions, 0) - rig.surface.evaluate(vectors, site)),
            evaluator.positionBound(weights));
  EXPECT_LE(evaluator.positionBound(weights), 1e-3);
  EXPECT_GE(dot(vectorOf(played.normals, 0), rig.surface.normal(vectors, site)), 0.99);
}

}  // namespace
}  // namespace sweepface
