#include "sweepface/measure.hpp"

#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"

#include "fit/roughly.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// The rig's own vertices and targets as a mesh.
MeshRig exported(const Rig& rig, const MeshRig& source) {
  MeshRig mesh = source;
  const Tessellation level1(rig.surface, 1);
  Weights weights(rig.targets.size(), 0);
  mesh.neutral.positions = sourcePositions(rig, level1, blend(rig, weights), weights);
  for (std::size_t k = 0; k < rig.targets.size(); ++k) {
    weights[k] = 1;
    mesh.targets[k].positions = sourcePositions(rig, level1, blend(rig, weights), weights);
    weights[k] = 0;
  }
  return mesh;
}

class EveryMeasure : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(Measure, EveryMeasure, eachFace(), faceName);

TEST_P(EveryMeasure, findsNoDistanceToTheRigsOwnExport) {
  const Rig rig = roughly(GetParam().rig);
  const auto m = measure(rig, exported(rig, GetParam().rig));
  ASSERT_TRUE(m) << m.error().message;
  ASSERT_EQ(m->shapes.size(), 3u);
  for (const PoseErrors& e : m->shapes) EXPECT_EQ(e.distance.max, 0) << e.name;
  ASSERT_EQ(m->mixtures.size(), 10u);
  for (const PoseErrors& e : m->mixtures)
    EXPECT_LT(e.distance.max, 1e-12 * diagonal(GetParam().rig.neutral)) << e.name;
  EXPECT_EQ(m->worst.distance.rms, 0);
}

TEST_P(EveryMeasure, showsAKnownDisplacementAsThatDistance) {
  const Rig rig = roughly(GetParam().rig);
  MeshRig source = exported(rig, GetParam().rig);
  for (Vec3& p : source.targets[1].positions) p += {0.3, -0.4, 1.2};
  const auto m = measure(rig, source);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->shapes[0].distance.max, 0);
  EXPECT_EQ(m->shapes[1].distance.max, 0);
  for (double d : {m->shapes[2].distance.max, m->shapes[2].distance.p999, m->shapes[2].distance.rms,
                   m->worst.distance.max})
    EXPECT_NEAR(d, 1.3, 1e-12);
  EXPECT_NEAR(m->worst.distance.rms, 1.3 / std::sqrt(3), 1e-12);
}

// Displacements from the neutral do not depend on where the whole face is.
TEST_P(EveryMeasure, findsNoErrorInDisplacementsOfAShiftedFace) {
  const Rig rig = roughly(GetParam().rig);
  MeshRig source = exported(rig, GetParam().rig);
  for (Vec3& p : source.neutral.positions) p += {0.3, -0.4, 1.2};
  for (MeshTarget& t : source.targets)
    for (Vec3& p : t.positions) p += {0.3, -0.4, 1.2};
  const auto m = measure(rig, source);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_NEAR(m->worst.distance.rms, 1.3, 1e-12);
  EXPECT_LT(m->worst.displacement.max, 1e-12);
  for (const PoseErrors& e : m->mixtures) EXPECT_LT(e.displacement.max, 1e-12) << e.name;
}

TEST_P(EveryMeasure, showsAWrongNeutralInTheDisplacementsOfAllTargets) {
  const Rig rig = roughly(GetParam().rig);
  MeshRig source = exported(rig, GetParam().rig);
  for (Vec3& p : source.neutral.positions) p += {0.3, -0.4, 1.2};
  for (Vec3& p : source.targets[1].positions) p += {0.3, -0.4, 0};
  const auto m = measure(rig, source);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->shapes[0].displacement.max, 0);
  EXPECT_EQ(m->shapes[1].distance.max, 0);
  EXPECT_NEAR(m->shapes[1].displacement.p99, 1.3, 1e-12);
  EXPECT_NEAR(m->shapes[2].displacement.rms, 1.2, 1e-12);
  EXPECT_NEAR(m->worst.displacement.max, 1.3, 1e-12);
  EXPECT_NEAR(m->worst.displacement.rms, std::sqrt((1.69 + 1.44) / 2), 1e-12);
  EXPECT_EQ(m->displacements.size(), 2 * source.neutral.positions.size());
  EXPECT_TRUE(std::ranges::is_sorted(m->displacements));
}

TEST(Measure, findsNoAngleOnAPlane) {
  const MeshRig flat{grid(6, 5, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
  const auto m = measure(roughly(flat), flat);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_LT(m->worst.angle.max, 1e-6);
  EXPECT_LT(m->worst.shadingRms, 1e-6);
  EXPECT_LT(m->worst.facetDistance, 1e-6);
  EXPECT_EQ(m->worst.folds, 0);
  EXPECT_TRUE(m->mixtures.empty());
}

TEST(Measure, showsAKnownLiftInTheFacets) {
  const MeshRig flat{grid(6, 5, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
  MeshRig lifted = flat;
  for (Vec3& p : lifted.neutral.positions) p.z += 0.3;
  const auto m = measure(roughly(flat), lifted);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_NEAR(m->worst.facetDistance, 0.3, 1e-6);
  EXPECT_NEAR(m->worst.facetExcess, 0.3, 1e-6);
}

TEST(Measure, showsAKnownTiltAsThatAngle) {
  const auto tilted = [](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return grid(6, 5,
                [=](double x, double y) { return Vec3{x, y * std::cos(a), y * std::sin(a)}; });
  };
  const MeshRig flat{tilted(0), {}}, raised{tilted(5), {}};
  const auto m = measure(roughly(flat), raised);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_NEAR(m->worst.angle.max, 5, 1e-4);
  EXPECT_NEAR(m->worst.angle.rms, 5, 1e-4);
  EXPECT_NEAR(m->worst.shadingRms, 5, 1e-4);
}

// Every vertex of a pleated sheet lies on a crest, where the normal is that of a plane.
TEST(Measure, seesWavesBetweenVertices) {
  const auto pleated = [](double x, double y) {
    return Vec3{x, y, std::lround(x) % 2 == 0 ? 0.2 : -0.2};
  };
  const MeshRig source = withTargets(grid(12, 6, pleated), 1);
  ConvertOptions options;
  options.tolerance = 0.001;
  const auto m = measure(convert(source, options).value().rig, source);
  ASSERT_TRUE(m) << m.error().message;
  for (const PoseErrors* e : {&m->shapes[0], &m->worst}) {
    EXPECT_LT(e->angle.rms, 3);
    EXPECT_GT(e->shadingRms, 15);
    EXPECT_LT(e->shadingRms, 32) << "a sine of this height is 22 degrees steep, RMS";
  }
}

TEST(Measure, seesAnOutlierInTheMaximumOnly) {
  const MeshRig source{plane(50, 50), {}};
  const Rig rig = roughly(source);
  MeshRig moved = exported(rig, source);
  moved.neutral.positions[1300].z += 1;
  const auto m = measure(rig, moved, {.facets = false});
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_NEAR(m->worst.distance.max, 1, 1e-12);
  EXPECT_EQ(m->worst.distance.p999, 0);
  EXPECT_EQ(m->worst.displacement.max, 0);  // there are no targets
  EXPECT_NEAR(m->worst.distance.rms, 1 / std::sqrt(51.0 * 51), 1e-12);
}

TEST(Measure, sumsUpErrors) {
  std::vector<double> errors;
  for (int k = 1000; k >= 0; --k) errors.push_back(k);
  const ErrorSummary s = summaryOf(errors);
  EXPECT_EQ(s.p99, 990);
  EXPECT_EQ(s.p999, 999);
  EXPECT_EQ(s.max, 1000);
  EXPECT_NEAR(s.rms, std::sqrt(1000 * 2001 / 6.0), 1e-9);
  EXPECT_EQ(summaryOf({}).max, 0);
}

TEST(Measure, countsFolds) {
  const MeshRig source{plane(8, 8), {}};
  Rig rig = roughly(source);
  EXPECT_EQ(measure(rig, source)->worst.folds, 0);
  for (Vec3& v : rig.neutral) v.x = -v.x;  // flips every triangle of level 4
  EXPECT_EQ(measure(rig, source)->worst.folds, 2 * 16 * 8 * 8);
}

TEST(Measure, countsFoldsByThemselvesAlike) {
  const MeshRig source = withTargets(plane(8, 8), 2);
  Rig rig = roughly(source);
  for (Vec3& d : rig.targets[1].difference) d.x = -1.5 * d.x;
  for (std::size_t v = 0; v < rig.neutral.size(); v += 3) rig.neutral[v].x *= -1;
  const std::vector<Index> folds = countFolds(rig, source);
  const Measurement measured = measure(rig, source).value();
  ASSERT_EQ(folds.size(), measured.shapes.size());
  for (std::size_t k = 0; k < folds.size(); ++k) EXPECT_EQ(folds[k], measured.shapes[k].folds) << k;
  EXPECT_GT(folds[0], 0);
}

TEST(Measure, leavesOutFacetsWhereNobodyAsks) {
  const MeshRig source = withTargets(plane(8, 8));
  const Rig rig = roughly(source);
  const Measurement all = measure(rig, source).value();
  const Measurement some = measure(rig, source, {.facets = false}).value();
  EXPECT_GT(all.worst.facetDistance, 0);
  EXPECT_EQ(some.worst.facetDistance, 0);
  EXPECT_EQ(some.worst.distance.max, all.worst.distance.max);
  EXPECT_EQ(some.worst.angle.p99, all.worst.angle.p99);
}

TEST(Measure, countsAFoldBetweenVerticesThatFit) {
  const MeshRig source{grid(8, 8, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
  ConvertOptions options;
  options.tolerance = 1;
  Rig rig = convert(source, options).value().rig;
  rig.tolerance = 0.01;  // facets no larger than the tolerance are ignored
  for (Index v = 0; v < rig.surface.storedCount(); ++v)
    if (const StoredVector& s = rig.surface.stored(v); s.i + s.j == 1) rig.neutral[v] *= 12.0;
  EXPECT_GT(measure(rig, source)->worst.folds, 0);
}

TEST(Measure, drawsTheSameMixturesFromTheSameSeed) {
  const MeshRig& source = everyFace()[0].rig;
  const Rig rig = roughly(source);
  const auto rms = [&](unsigned seed) {
    std::vector<double> list;
    const Measurement m = measure(rig, source, {4, seed}).value();
    for (const PoseErrors& e : m.mixtures) list.push_back(e.distance.rms);
    return list;
  };
  EXPECT_EQ(rms(3).size(), 4u);
  EXPECT_EQ(rms(3), rms(3));
  EXPECT_NE(rms(3), rms(4));
}

TEST(Measure, findsTargetsByName) {
  MeshRig source = everyFace()[0].rig;
  const Rig rig = roughly(source);
  source = exported(rig, source);
  std::swap(source.targets[0], source.targets[1]);
  EXPECT_EQ(measure(rig, source)->worst.distance.max, 0);
  source.targets.pop_back();
  EXPECT_EQ(measure(rig, source)->shapes.size(), 2u);
}

TEST(Measure, refusesWhatDoesNotBelongTogether) {
  const MeshRig source = everyFace()[0].rig;
  const Rig rig = roughly(source);
  MeshRig renamed = source;
  renamed.targets[1].name = "frown";
  EXPECT_EQ(measure(rig, renamed).error().message,
            "the model has no target named 'frown'; give the targets it was converted from");
  MeshRig cut = source;
  cut.targets[0].positions.pop_back();
  EXPECT_EQ(measure(rig, cut).error().message,
            "the target '" + cut.targets[0].name + "' has 98 vertices, and the neutral 99");
  Rig undecoded = rig;
  undecoded.targets[0].difference.clear();
  EXPECT_NE(measure(undecoded, source).error().message.find("not decoded yet"), std::string::npos);
  EXPECT_EQ(measure(rig, withTargets(plane(3, 3))).error().message,
            "the neutral has 16 vertices, the model was made from 99; give the mesh it was "
            "converted from, chosen and subdivided in the same way");
}

TEST(Measure, endsWhereItIsGivenUp) {
  const MeshRig source = everyFace()[0].rig;
  const std::atomic<bool> cancel = true;
  const auto measured = measure(roughly(source), source, {.cancel = &cancel});
  ASSERT_FALSE(measured);
  EXPECT_EQ(measured.error().message, "measuring was interrupted");
}

TEST(Measure, needsToKnowWhereTheFacetsLie) {
  const MeshRig source = withTargets(plane(12, 10));
  Rig rig = roughly(source);
  rig.source.quadCorners.clear();
  const auto m = measure(rig, source);
  ASSERT_FALSE(m);
  EXPECT_NE(m.error().message.find("does not tell"), std::string::npos) << m.error().message;
  const auto atVertices = measure(rig, source, {.facets = false});
  ASSERT_TRUE(atVertices) << atVertices.error().message;
  EXPECT_GT(atVertices->worst.distance.max, 0);
}

}  // namespace
}  // namespace sweepface
