#include "codec/bones.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "codec/encoding.hpp"
#include "codec/files.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using codec::Bones;
using Carry = Packing::Carry;

// A sheet that one bone carries as a whole.
class ASheetOnABone : public ::testing::Test {
 protected:
  ASheetOnABone() {
    packing.targetStep = 0.5;
    packing.bones.assign(surface.storedCount(), 0);
    for (Index v = 0; v < surface.storedCount(); ++v) neutral.push_back(anyVector(v));
  }
  std::vector<Vec3> carried(const Carry& carry) const {
    std::vector<Vec3> moves(neutral.size());
    EXPECT_TRUE(Bones(surface, packing, neutral).add(std::span(&carry, 1), 1, moves));
    return moves;
  }
  bool isPosition(Index v) const { return surface.stored(v).i + surface.stored(v).j == 0; }

  Surface surface = Surface::make(onePatch(7, 4)).value();
  Packing packing;
  std::vector<Vec3> neutral;
};

TEST_F(ASheetOnABone, ShiftsPositionsInSixteenthsOfTheStepAndLeavesDerivatives) {
  const auto moves = carried({0, {{{16, -32, 1}, {}, {}, {}}}});
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const Vec3 expected = isPosition(v) ? Vec3{0.5, -1, 0.03125} : Vec3{};
    EXPECT_EQ(moves[v], expected);
  }
}

TEST_F(ASheetOnABone, MovesEveryVectorByOneAffineMap) {
  const auto moves = carried({0, {{{3, 5, -7}, {100, 20, 0}, {-30, 0, 4}, {0, 9, -80}}}});
  // Derivatives follow the map's linear part alone, as differences of positions do.
  Vec3 least = neutral[0], most = neutral[0];
  for (Index v = 0; v < surface.storedCount(); ++v)
    if (isPosition(v)) {
      const Vec3& p = neutral[v];
      least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
    }
  const Vec3 across = most - least;
  const double scale = 2 / std::max({across.x, across.y, across.z});
  const double unit = 0.5 / 16;
  for (Index v = 0; v < surface.storedCount(); ++v) {
    Vec3 at = scale * (isPosition(v) ? neutral[v] - 0.5 * (least + most) : neutral[v]);
    Vec3 expected = at.x * Vec3{100, 20, 0} + at.y * Vec3{-30, 0, 4} + at.z * Vec3{0, 9, -80};
    if (isPosition(v)) expected += Vec3{3, 5, -7};
    EXPECT_NEAR(norm(moves[v] - unit * expected), 0, 1e-12);
  }
}

TEST_F(ASheetOnABone, TakesAwayWhatItAdds) {
  const Bones bones(surface, packing, neutral);
  const std::vector<Carry> carries{{0, {{{3, 5, -7}, {100, 20, 0}, {-30, 0, 4}, {0, 9, -80}}}}};
  std::vector<Vec3> moves(neutral.size());
  bones.add(carries, 1, moves);
  bones.add(carries, -1, moves);
  for (const Vec3& m : moves) EXPECT_NEAR(norm(m), 0, 1e-12);
}

TEST_F(ASheetOnABone, HasNoSizeWhereAllStandsAtOnePlace) {
  std::ranges::fill(neutral, Vec3{1, 2, 3});
  for (const Vec3& m : carried({0, {{{0, 0, 0}, {9, 9, 9}, {9, 9, 9}, {9, 9, 9}}}}))
    EXPECT_EQ(m, Vec3{});
}

TEST_F(ASheetOnABone, SaysWhatIsTooLarge) {
  packing.targetStep = 1e18;
  for (const codec::Steps3 shift :
       {codec::Steps3{1 << 26, 0, 0}, codec::Steps3{1 << 26, -(1 << 26), 0}}) {
    const Carry carry{0, {{shift, {}, {}, {}}}};
    const auto isTold = [&] {
      std::vector<Vec3> moves(neutral.size());
      return Bones(surface, packing, neutral).add(std::span(&carry, 1), 1, moves);
    };
    packing.targetStep = 1e18;
    EXPECT_TRUE(isTold());
    packing.targetStep = 1e24;
    EXPECT_FALSE(isTold());
  }
}

Rig withBones() {
  Rig rig = makeRig(twoPatches());
  addBones(rig);
  return packed(std::move(rig));
}

TEST(BonesOfAFile, ComeBackWithWhatTheyCarry) {
  const Rig rig = withBones();
  const std::string bytes = encode(rig);
  const auto back = decode(bytes, "a.sweep");
  ASSERT_TRUE(back) << back.error().message;
  expectEqual(*back, rig);
  EXPECT_EQ(back->packing.bones, rig.packing.bones);
  EXPECT_EQ(back->packing.poses, rig.packing.poses);
  EXPECT_EQ(encode(*back), bytes);
}

std::size_t bytesOfTargets(const Rig& rig) {
  for (const FileChunk& chunk : takeApart(encode(rig)))
    if (chunk.code == "MOVE") return chunk.payload.size();
  return 0;
}

TEST(BonesOfAFile, MakeATurnOfAPartCheap) {
  // The whole sheet makes a quarter turn about its centre.
  Rig rig = makeRig(sheet(8));
  for (Target& target : rig.targets) target.difference.assign(rig.neutral.size(), {});
  rig = packed(std::move(rig));
  rig.packing.bones.assign(rig.neutral.size(), 0);
  rig.packing.poses[1].carries = {{0, {{{0, 0, 0}, {-800, 800, 0}, {-800, -800, 0}, {0, 0, 0}}}}};
  Bones(rig.surface, rig.packing, rig.neutral)
      .add(rig.packing.poses[1].carries, 1, rig.targets[0].difference);
  const std::size_t carried = bytesOfTargets(rig);
  rig.packing.bones.clear();
  rig.packing.poses[1].carries.clear();
  EXPECT_LT(2 * carried, bytesOfTargets(packed(rig)));
}

TEST(BonesOfAFile, MustBeThere) {
  const std::string payload = codec::ranged([](auto& out) {
    out.number(codec::kBones, 0, 0, 1);
    out.bit(codec::kSameBone, 0, 4 + 1, false);
    out.number(codec::kBone, 0, 0, std::uint64_t{1} << 31);
  });
  const auto refused = decode(withPayload(encode(withBones()), "MOVE", payload + "UU"), "a.sweep");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("no such bone"), std::string::npos);
}

TEST(BonesOfAFile, MustNotCarryBeyondAFloat) {
  Rig rig = withBones();
  rig.packing.targetStep = 1e26;
  const auto refused = decode(encode(rig), "a.sweep");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("a coordinate is too large"), std::string::npos)
      << refused.error().message;
}

TEST(BonesOfAFile, AreMadeSound) {
  Rig rig = withBones();
  rig.packing.bones[3] = 1 << 20;
  rig.packing.bones[2] = -7;
  rig.packing.poses[0].carries = {{0, {}}};
  rig.packing.poses[1].carries = {{1, {}}, {0, {}}, {99, {}}, {-1, {}}};
  rig.packing.poses[2].carries[0].by[0][0] = INT32_MAX;
  const std::string bytes = encode(rig);
  const auto back = decode(bytes, "a.sweep");
  ASSERT_TRUE(back) << back.error().message;
  expectEqual(*back, rig);
  EXPECT_EQ(encode(*back), bytes);
  EXPECT_EQ(back->packing.poses[1].carries, (std::vector<Carry>{{1, {}}}));
  rig.packing.bones.pop_back();  // no longer one for each vector
  EXPECT_TRUE(decode(encode(rig), "a.sweep").value().packing.bones.empty());
}

}  // namespace
}  // namespace sweepface
