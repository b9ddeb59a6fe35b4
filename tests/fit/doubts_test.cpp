#include "fit/doubts.hpp"

#include <gtest/gtest.h>
#include <random>

#include "sweepface/fit.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A face with a target of the same name for each of these.
MeshRig rigWith(std::initializer_list<std::pair<const char*, std::vector<Vec3>>> targets) {
  MeshRig rig{plane(), {}};
  for (const auto& [name, positions] : targets) rig.targets.push_back({name, positions});
  return rig;
}
std::vector<Vec3> opened() { return withTargets(plane(), 1).targets[0].positions; }
std::vector<Vec3> scaled(double factor) {
  std::vector<Vec3> positions = plane().positions;
  for (Vec3& p : positions) p *= factor;
  return positions;
}
std::vector<Vec3> shuffled() {
  std::vector<Vec3> positions = opened();
  std::ranges::shuffle(positions, std::mt19937(3));
  return positions;
}

TEST(Doubts, AreNoneOfAFaceAsTheyAre) {
  EXPECT_TRUE(doubtsAbout(rigWith({{"open", opened()}, {"twice", scaled(2)}}), 0.01).empty());
  EXPECT_TRUE(doubtsAbout(rigWith({}), 0.01).empty());
}

TEST(Doubts, AreOfTargetsOfAnotherOrderOrInOtherUnits) {
  for (const auto& positions : {shuffled(), scaled(100), scaled(0.01)}) {
    const auto doubts = doubtsAbout(rigWith({{"open", opened()}, {"odd", positions}}), 0.01);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_NE(doubts[0].find("the neutral's in 'odd': vertices may be in another order"),
              std::string::npos)
        << doubts[0];
  }
}

TEST(Doubts, AreOfTargetsThatMoveNothing) {
  MeshRig rig = rigWith({{"open", opened()}, {"still", plane().positions}});
  // A vertex of no face does not count.
  rig.neutral.positions.push_back({});
  for (MeshTarget& target : rig.targets) target.positions.push_back({5, 5, 5});
  const auto doubts = doubtsAbout(rig, 0.01);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0], "No vertex moves by more than the tolerance in 'still', which may be lost.");
}

TEST(Doubts, NameSixTargetsAtMost) {
  MeshRig rig = rigWith({});
  for (int k = 0; k < 9; ++k)
    rig.targets.push_back({"t" + std::to_string(k), rig.neutral.positions});
  EXPECT_NE(doubtsAbout(rig, 0.01)[0].find("'t4', 't5' and 3 more, which"), std::string::npos);
}

TEST(Doubts, AreOfAToleranceLikeTheMesh) {
  const MeshRig rig = rigWith({});
  const double size = diagonal(rig.neutral);
  EXPECT_TRUE(doubtsAbout(rig, 0.049 * size).empty());
  const auto doubts = doubtsAbout(rig, 0.25 * size);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("is 25 % of the mesh's size"), std::string::npos) << doubts[0];
}

TEST(Doubts, AreToldByConvert) {
  const MeshRig rig = rigWith({{"still", plane().positions}});
  const auto conversion = convert(rig);
  ASSERT_TRUE(conversion) << conversion.error().message;
  ASSERT_EQ(conversion->warnings.size(), 1u);
  EXPECT_NE(conversion->warnings[0].find("'still'"), std::string::npos);
}

}  // namespace
}  // namespace sweepface
