#include "codec/turns.hpp"

#include "codec/chunks.hpp"
#include "codec/files.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(TurnsOfAFile, AreHeldInSinglePrecision) {
  Rig rig = makeRig(onePatch(2, 2));
  rig.turns = {{0, {0.1, 0.2, 0.3}, normalized({1, 2, 3})}, {2, {-1e-3, 7, 1e5}, {}}};
  const auto again = decode(encode(rig), "turns");
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->turns.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(again->turns[k].target, rig.turns[k].target);
    EXPECT_LE(norm(again->turns[k].pivot - rig.turns[k].pivot), 6e-8 * norm(rig.turns[k].pivot));
    EXPECT_LE(norm(again->turns[k].axis - rig.turns[k].axis), 1e-7);
  }
  EXPECT_EQ(encode(*again), encode(rig));
}

TEST(TurnsOfAFile, AreOnlyThoseThatItCanHold) {
  Rig rig = makeRig(onePatch(2, 2));
  const Vec3 nan{std::nan(""), 0, 0};
  rig.turns = {{1, {}, {}},        {1, {1, 1, 1}, {}}, {0, {}, {}}, {2, nan, {}},
               {2, {}, {2, 0, 0}}, {9, {}, {}},        {-1, {}, {}}};
  const auto again = decode(encode(rig), "turns");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->turns, (std::vector<Turn>{{1, {}, {}}}));
}

std::string payload(std::initializer_list<unsigned> numbers, std::initializer_list<float> floats) {
  codec::Writer out;
  for (const unsigned n : numbers) out.number(n);
  for (const float x : floats) out.f32(x);
  return out.take();
}

bool isRefused(const std::string& bytes) {
  codec::Reader in(bytes, 0);
  codec::readTurns(in, 3);
  return !in.ok();
}

TEST(TurnsOfAFile, AreRefusedWhereTheyAreUnsound) {
  EXPECT_FALSE(isRefused(payload({1, 1}, {1, 2, 3})));
  EXPECT_FALSE(isRefused(payload({1, 4}, {1, 2, 3, 0, 0, 1})));
  EXPECT_TRUE(isRefused(payload({1, 7}, {1, 2, 3})));           // no such target: 3
  EXPECT_TRUE(isRefused(payload({1, 0}, {1, 2, 3, 0, 0, 2})));  // not a unit axis
  EXPECT_TRUE(isRefused(payload({1, 0}, {1, 2, 3})));           // truncated
  EXPECT_TRUE(isRefused(payload({1, 1}, {1, 2, std::nanf("")})));
  EXPECT_TRUE(isRefused(payload({1000000}, {})));
}

}  // namespace
}  // namespace sweepface
