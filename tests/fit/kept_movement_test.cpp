#include <gtest/gtest.h>

#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

TEST(KeptMovement, IsAllWithinAFineTolerance) {
  MeshRig source = withTargets(plane());
  source.targets.push_back({"still", source.neutral.positions});
  const auto conversion = convert(source);
  ASSERT_TRUE(conversion) << conversion.error().message;
  const auto kept = keptMovement(conversion->rig, source);
  ASSERT_EQ(kept.size(), 3u);
  for (const double share : kept) EXPECT_NEAR(share, 1, 0.01);
}

TEST(KeptMovement, IsTheShareThatTheRigHas) {
  const MeshRig source = withTargets(plane());
  auto rig = convert(source)->rig;
  for (Vec3& d : rig.targets[0].difference) d *= 0.25;
  for (Vec3& d : rig.targets[1].difference) d *= 0;
  const auto kept = keptMovement(rig, source);
  EXPECT_NEAR(kept[0], 0.25, 0.01);
  EXPECT_EQ(kept[1], 0);
  EXPECT_EQ(lostMovement(source, kept),
            "Most of the movement is within the tolerance and lost in '" + source.targets[0].name +
                "' (25 % left), '" + source.targets[1].name + "' (0 % left).");
  EXPECT_EQ(lostMovement(source, {1, 0.51}), "");
  EXPECT_TRUE(lostMovement(source, {1, -0.25}).ends_with("(0 % left).")) << "the other way";
}

}  // namespace
}  // namespace sweepface
