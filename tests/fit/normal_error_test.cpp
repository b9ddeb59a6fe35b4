#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "fit/roughly.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

void expectMeasured(const NormalErrors& errors, const ErrorSummary& measured) {
  EXPECT_NEAR(errors.rms, measured.rms, 1e-9);
  EXPECT_NEAR(errors.max, measured.max, 1e-9);
}

class EveryNormalError : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(NormalError, EveryNormalError, eachFace(), faceName);

TEST_P(EveryNormalError, isWhatIsMeasured) {
  const MeshRig& source = GetParam().rig;
  const Rig rig = roughly(source);
  expectMeasured(normalErrors(rig, source), measure(rig, source)->worst.angle);
}

/// A part of the mesh that shrinks to a point has no normals; all others count equally.
TEST(NormalError, isOverAllVerticesOfAllExpressions) {
  MeshRig source = withTargets(plane());
  const Rig rig = roughly(source);
  for (Vec3& p : source.targets[0].positions) p = p.x < 8 ? Vec3{} : Vec3{p.z, p.x, p.y};
  expectMeasured(normalErrors(rig, source), measure(rig, source)->worst.angle);
}

}  // namespace
}  // namespace sweepface
