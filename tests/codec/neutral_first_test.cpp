#include <gtest/gtest.h>

#include "codec/files.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(NeutralFirst, ShowsBeforeItsTargetsAreDecoded) {
  for (const Rig& rig : {packed(makeRig(fan(5))), packed(makeRig(tee()))}) {
    const std::string bytes = encode(rig);
    NeutralFirst opened = decodeNeutral(bytes, "a.sweep").value();
    EXPECT_TRUE(opened.targets.any());
    EXPECT_EQ(opened.rig.neutral, rig.neutral);
    expectEqual(opened.rig.source.polygons, rig.source.polygons);
    ASSERT_EQ(opened.rig.targets.size(), rig.targets.size());
    for (std::size_t k = 0; k < rig.targets.size(); ++k) {
      EXPECT_EQ(opened.rig.targets[k].name, rig.targets[k].name);
      EXPECT_TRUE(opened.rig.targets[k].difference.empty());
    }
    EXPECT_EQ(blend(opened.rig, Weights(rig.targets.size(), 1)), blend(rig, {}));
    ASSERT_TRUE(opened.targets.decode(opened.rig));
    EXPECT_FALSE(opened.targets.any());
    expectEqual(opened.rig, decode(bytes, "a.sweep").value());
    EXPECT_TRUE(opened.targets.decode(opened.rig)) << "there is nothing left to do";
  }
}

TEST(NeutralFirst, ShowsVerticesOfNoFace) {
  Rig rig = makeRig(tee());
  rig.source.loose = {{1, 2, 3}, {4, 5, 6}};
  for (Target& target : rig.targets) target.looseDifference.resize(2);
  const NeutralFirst opened = decodeNeutral(encode(packed(rig)), "a.sweep").value();
  ASSERT_TRUE(opened.targets.any());
  EXPECT_EQ(blendLoose(opened.rig, Weights(rig.targets.size(), 1)), rig.source.loose);
}

TEST(NeutralFirst, IsWrittenAsIfNothingMoved) {
  const Rig rig = packed(makeRig(tee()));
  const NeutralFirst opened = decodeNeutral(encode(rig), "a.sweep").value();
  const Rig still = decode(encode(opened.rig), "a.sweep").value();
  EXPECT_EQ(still.neutral, rig.neutral);
  ASSERT_EQ(still.targets.size(), rig.targets.size());
  for (const Target& target : still.targets)
    EXPECT_EQ(target.difference, std::vector<Vec3>(rig.neutral.size()));
}

TEST(NeutralFirst, KeepsNothingOfTheBytesNorOfThePlaceOfTheRig) {
  auto bytes = std::make_unique<std::string>(encode(packed(makeRig(tee()))));
  const Rig whole = decode(*bytes, "a.sweep").value();
  auto opened = std::make_unique<NeutralFirst>(decodeNeutral(*bytes, "a.sweep").value());
  bytes = nullptr;
  Rig moved = std::move(opened->rig);
  TargetsToCome targets = std::move(opened->targets);
  opened = nullptr;
  ASSERT_TRUE(targets.decode(moved));
  expectEqual(moved, whole);
}

TEST(NeutralFirst, IsAllThereIsOfAFileWithVectorsAsTheyAre) {
  for (const Rig& rig : {everything(), makeRig(tee()), packed(dressed(makeRig(tee())))}) {
    const NeutralFirst opened = decodeNeutral(encode(rig), "a.sweep").value();
    EXPECT_FALSE(opened.targets.any());
    expectEqual(opened.rig, rig);
  }
}

TEST(NeutralFirst, SaysWhereItsTargetsAreWrongAndLeavesThemEmpty) {
  const std::string bytes =
      withPayload(encode(packed(makeRig(tee()))), "MOVE", std::string(50, '\x5a'));
  NeutralFirst opened = decodeNeutral(bytes, "a.sweep").value();
  for (int k = 0; k < 2; ++k) {
    const auto done = opened.targets.decode(opened.rig);
    ASSERT_FALSE(done);
    EXPECT_TRUE(done.error().message.starts_with("a.sweep, chunk 'MOVE', byte "))
        << done.error().message;
    EXPECT_EQ(done.error().message, decode(bytes, "a.sweep").error().message);
    for (const Target& target : opened.rig.targets) EXPECT_TRUE(target.difference.empty());
  }
}

TEST(NeutralFirst, RefusesTheTargetsOfAnotherRig) {
  NeutralFirst opened = decodeNeutral(encode(packed(makeRig(tee()))), "a.sweep").value();
  Rig other = packed(makeRig(fan(5)));
  EXPECT_FALSE(opened.targets.decode(other));
  other = opened.rig;
  other.targets.push_back({"another", {}, {}});
  EXPECT_FALSE(opened.targets.decode(other));
  EXPECT_TRUE(opened.targets.decode(opened.rig));
}

}  // namespace
}  // namespace sweepface
