#include "codec/likeness.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <random>

#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using codec::Coefficients;
using codec::Lattice;
using codec::Likenesses;

/// Coefficients of which about one in `one` is not zero. `where` and `values` are the seeds for
/// which ones these are and for their values.
Coefficients sparse(std::size_t count, int one, unsigned where, unsigned values) {
  std::mt19937 place(where), value(values);
  Coefficients q(count);
  for (auto& v : q)
    if (place() % one == 0) v[value() % 3] = 1 + static_cast<std::int32_t>(value() % 2);
  return q;
}

class AFewPoses : public ::testing::Test {
 protected:
  static Packing packing() {
    Packing packing;
    packing.neutralStep = packing.targetStep = 0.01;
    return packing;
  }
  Rig rig = makeRig(sheet(16));
  Lattice lattice{rig.surface, packing()};
  std::size_t count = rig.neutral.size();
};

TEST_F(AFewPoses, AreLikeTheOneThatMovesTheSameVectors) {
  const Coefficients still(count), a = sparse(count, 5, 1, 1), b = sparse(count, 5, 2, 2);
  const std::vector<Coefficients> poses{
      still, a, b, sparse(count, 5, 2, 3), still, sparse(count, 5, 1, 4)};
  const Likenesses likenesses(lattice, poses);
  EXPECT_EQ(likenesses.of(1).pose, -1) << "there is none before it but the neutral";
  EXPECT_EQ(likenesses.of(2).pose, -1) << "what moves elsewhere says nothing";
  EXPECT_EQ(likenesses.of(3).pose, 2);
  EXPECT_EQ(likenesses.of(4).pose, -1) << "what is still needs nobody";
  EXPECT_EQ(likenesses.of(5).pose, 1);
  EXPECT_FALSE(likenesses.of(5).negated);
}

TEST_F(AFewPoses, MayMoveTheOtherWay) {
  std::vector<Coefficients> poses{Coefficients(count), sparse(count, 5, 1, 1)};
  poses.push_back(poses[1]);
  for (auto& v : poses[2])
    for (auto& x : v) x = -x;
  const auto like = Likenesses(lattice, poses).of(2);
  EXPECT_EQ(like.pose, 1);
  EXPECT_TRUE(like.negated);
  Coefficients expected(count);
  for (const codec::Moved& m : hintsOf(like, lattice, poses)) expected[m.vector] = m.steps;
  EXPECT_EQ(expected, poses[2]);
}

// The file of eight targets, read back as a check. Target k moves the vectors with seed `where(k)`.
std::string fileOf(Rig rig, const Packing& packing,
                   const std::function<unsigned(unsigned)>& where) {
  rig.packing = packing;
  rig.targets.clear();
  Lattice lattice(rig.surface, packing);
  const std::size_t count = rig.neutral.size();
  lattice.restore(0, lattice.round(0, rig.neutral, 0.01), 0.01, rig.neutral);
  lattice.learn(rig.surface, rig.neutral, 0.01);
  for (unsigned k = 0; k < 8; ++k) {
    Target target{"t" + std::to_string(k), std::vector<Vec3>(count), {}};
    lattice.restore(1, sparse(count, 5, where(k), k), 0.01, target.difference);
    rig.targets.push_back(std::move(target));
  }
  const std::string bytes = encode(rig);
  const auto back = decode(bytes, "a.sweep");
  EXPECT_TRUE(back.has_value());
  if (back) {
    expectEqual(*back, rig);
    EXPECT_EQ(encode(*back), bytes);
  }
  return bytes;
}

TEST_F(AFewPoses, CostLessWhereTheyAreAlike) {
  const auto apart = fileOf(rig, packing(), [](unsigned k) { return k; });
  const auto inPairs = fileOf(rig, packing(), [](unsigned k) { return k / 2; });
  EXPECT_LT(100 * inPairs.size(), 98 * apart.size());
}

}  // namespace
}  // namespace sweepface
