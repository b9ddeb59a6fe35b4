#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "fit/roughly.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class EveryNormalError : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(NormalError, EveryNormalError, eachFace(), faceName);

TEST_P(EveryNormalError, isWhatIsMeasured) {
  const MeshRig& source = GetParam().rig;
  const Rig rig = roughly(source);
  EXPECT_NEAR(normalRms(rig, source), measure(rig, source)->worst.angle.rms, 1e-9);
}

/// A part of the mesh that shrinks to a point has no normals; all others count equally.
TEST(NormalError, isOverAllVerticesOfAllExpressions) {
  MeshRig source = withTargets(plane());
  const Rig rig = roughly(source);
  for (Vec3& p : source.targets[0].positions) p = p.x < 8 ? Vec3{} : Vec3{p.z, p.x, p.y};
  EXPECT_NEAR(normalRms(rig, source), measure(rig, source)->worst.angle.rms, 1e-9);
}

}  // namespace
}  // namespace sweepface
