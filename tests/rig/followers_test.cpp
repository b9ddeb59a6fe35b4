#include "sweepface/followers.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "allocations.hpp"

namespace sweepface {
namespace {

using Kind = Follower::Kind;

std::vector<double> applied(const std::vector<Follower>& followers, std::vector<double> weights) {
  Followers(followers).apply(weights);
  return weights;
}

// ---- Names ----

TEST(FollowerNames, joinedNamesAreProducts) {
  const std::vector<std::string> names{"jawOpen", "eyeBlink_L", "eyeBlink_L_jawOpen", "smile"};
  EXPECT_EQ(Followers::named(names), (std::vector<Follower>{{Kind::product, 2, {1, 0}, 0}}));
}

TEST(FollowerNames, productsOfMoreAreOfTheSimplest) {
  const std::vector<std::string> names{"A", "B", "C", "A_B", "A_B_C"};
  EXPECT_EQ(Followers::named(names), (std::vector<Follower>{{Kind::product, 3, {0, 1}, 0},
                                                            {Kind::product, 4, {0, 1, 2}, 0}}));
}

TEST(FollowerNames, ofMoreThanTwelveUnderscoresSayNothing) {
  const auto followersOf = [](int underscores) {
    std::string second = "B";
    for (int k = 1; k < underscores; ++k) second += "_B";
    return Followers::named(std::vector<std::string>{"A", second, "A_" + second});
  };
  EXPECT_EQ(followersOf(12), (std::vector<Follower>{{Kind::product, 2, {0, 1}, 0}}));
  EXPECT_TRUE(followersOf(13).empty());
}

TEST(FollowerNames, numbersAreInBetweens) {
  const std::vector<std::string> names{"blink_L", "blink_L_50", "blink_L25", "blink_L.75"};
  EXPECT_EQ(Followers::named(names), (std::vector<Follower>{{Kind::inBetween, 1, {0}, 0.5},
                                                            {Kind::inBetween, 2, {0}, 0.25},
                                                            {Kind::inBetween, 3, {0}, 0.75}}));
}

TEST(FollowerNames, otherNamesSayNothing) {
  const std::vector<std::string> names{"eye_L", "eye",    "viseme10", "jaw_",     "_jaw",
                                       "jaw",   "eye_00", "jaw_jaw",  "",         "_",
                                       "50",    "eye_1",  "shape_1",  "shape_110"};
  EXPECT_TRUE(Followers::named(names).empty());
}

// ---- Weights ----

TEST(Followers, productsMultiply) {
  const std::vector<Follower> followers{{Kind::product, 3, {0, 1, 2}, 0}};
  EXPECT_EQ(applied(followers, {0.5, 0.5, 1, 7}), (std::vector<double>{0.5, 0.5, 1, 0.25}));
  EXPECT_EQ(applied(followers, {0.5, 0, 1, 7}), (std::vector<double>{0.5, 0, 1, 0}));
}

TEST(Followers, inBetweensOfInBetweensDoNotDependOnTheOrderOfTargets) {
  // The targets are A, half of A's half, half of A; `plain` swaps the last two.
  const std::vector<Follower> nested{{Kind::inBetween, 1, {2}, 0.5},
                                     {Kind::inBetween, 2, {0}, 0.5}},
      plain{{Kind::inBetween, 1, {0}, 0.5}, {Kind::inBetween, 2, {1}, 0.5}};
  const auto a = applied(nested, {0.125, 0, 0}), b = applied(plain, {0.125, 0, 0});
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[2], b[1]);
  EXPECT_EQ(a[1], b[2]);
  EXPECT_GT(a[1], 0);
}

TEST(Followers, arcsAreFullHalfWay) {
  const std::vector<Follower> followers{{Kind::arc, 1, {0}, 0}};
  for (const auto& [w, expected] : {std::pair{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.0}, {0.25, 0.75}})
    EXPECT_EQ(applied(followers, {w, 9}), (std::vector<double>{w, expected}));
}

TEST(Followers, inBetweensHandOver) {
  const std::vector<Follower> followers{{Kind::inBetween, 2, {0}, 0.75},
                                        {Kind::inBetween, 1, {0}, 0.25}};
  const auto at = [&](double w) { return applied(followers, {w, 9, 9}); };
  EXPECT_EQ(at(0), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(at(0.25), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(at(0.5), (std::vector<double>{0, 0.5, 0.5}));
  EXPECT_EQ(at(0.75), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(at(0.875), (std::vector<double>{0.5, 0, 0.5}));
  EXPECT_EQ(at(1), (std::vector<double>{1, 0, 0}));
  // Beyond the ends, weights are extrapolated linearly.
  EXPECT_EQ(at(-0.25), (std::vector<double>{0, -1, 0}));
  EXPECT_EQ(at(1.25), (std::vector<double>{2, 0, -1}));
}

TEST(Followers, inBetweensThatAreThereTwiceHandOverOnce) {
  const std::vector<Follower> followers{{Kind::inBetween, 1, {0}, 0.5},
                                        {Kind::inBetween, 2, {0}, 0.5}};
  const auto at = [&](double w) { return applied(followers, {w, 9, 9}); };
  EXPECT_EQ(at(0.5), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(at(0.75), (std::vector<double>{0.5, 0.5, 0}));
}

TEST(Followers, productsOfInBetweensThatAreThereTwiceAreStill) {
  const std::vector<Follower> followers{{Kind::inBetween, 1, {0}, 0.5},
                                        {Kind::inBetween, 2, {0}, 0.5},
                                        {Kind::product, 4, {2, 3}, 0}};
  EXPECT_EQ(applied(followers, {0.5, 0, 9, 1, 9}), (std::vector<double>{0, 1, 0, 1, 0}));
}

TEST(Followers, areFiniteHoweverLargeLeadersAre) {
  const std::vector<Follower> followers{{Kind::product, 2, {0, 1}, 0}};
  EXPECT_EQ(applied(followers, {1e5, -1e5, 0})[2], -1e6);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(applied(followers, {infinite, 0, 0}), (std::vector<double>{1e6, 0, 0}));
}

TEST(Followers, productsGoByTheWeightsThatWereSet) {
  const std::vector<Follower> followers{{Kind::inBetween, 1, {0}, 0.5},
                                        {Kind::product, 3, {0, 2}, 0}};
  EXPECT_EQ(applied(followers, {0.5, 0, 1, 0}), (std::vector<double>{0, 1, 1, 0.5}));
}

TEST(FollowerNames, ofProductsSayNothing) {
  const std::vector<std::string> names{"A", "B", "A_B_A", "A_B"};
  EXPECT_EQ(Followers::named(names), (std::vector<Follower>{{Kind::product, 3, {0, 1}, 0}}));
}

TEST(Followers, productsOfInBetweensGoByWhatTheseAreGiven) {
  const std::vector<std::string> names{"A", "A_50_B", "A_50", "B"};
  const auto followers = Followers::named(names);
  EXPECT_EQ(applied(followers, {0.5, 9, 9, 0.5}), (std::vector<double>{0, 0.5, 1, 0.5}));
  EXPECT_EQ(applied(followers, {0.75, 9, 9, 1}), (std::vector<double>{0.5, 0.5, 0.5, 1}));
  EXPECT_EQ(applied(followers, {1, 9, 9, 1}), (std::vector<double>{1, 0, 0, 1}));
}

TEST(Followers, productsOfInBetweensDoNotWaitUntilTheseHandOver) {
  const std::vector<std::string> names{"A", "A_50", "A_50_60", "B", "A_50_B"};
  EXPECT_EQ(applied(Followers::named(names), {0.3, 9, 9, 0.5, 9}),
            (std::vector<double>{0, 0, 1, 0.5, 0.3}));
}

TEST(Followers, productsOfInBetweensHandOverTheirOwnWeight) {
  const std::vector<std::string> names{"A", "A_50", "B", "A_50_B", "A_50_B_75"};
  EXPECT_EQ(applied(Followers::named(names), {0.25, 9, 0.75, 9, 9}),
            (std::vector<double>{0, 0.5, 0.75, 0, 0.5}));
}

TEST(Followers, arcsGoByWhatTheirLeaderIsGiven) {
  const std::vector<Follower> followers{{Kind::product, 2, {0, 1}, 0},
                                        {Kind::inBetween, 3, {0}, 0.5},
                                        {Kind::arc, 4, {2}, 0},
                                        {Kind::arc, 5, {3}, 0}};
  EXPECT_EQ(applied(followers, {0.25, 1, 0, 0, 0, 0}),
            (std::vector<double>{0, 1, 0.25, 0.5, 0.75, 1}));
}

TEST(Followers, whereInBetweensTellTheWayThereIsNoArcBeside) {
  const std::vector<Follower> followers{
      {Kind::inBetween, 1, {0}, 0.5}, {Kind::arc, 2, {0}, 0}, {Kind::arc, 3, {1}, 0}};
  EXPECT_EQ(applied(followers, {0.25, 9, 9, 9}), (std::vector<double>{0, 0.5, 0, 1}));
}

TEST(Followers, allocateNothing) {
  if (!testing::watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const Followers followers(
      {{Kind::inBetween, 1, {0}, 0.5}, {Kind::product, 3, {0, 2}, 0}, {Kind::arc, 4, {2}, 0}});
  std::vector<double> weights{0.25, 0, 0.5, 0, 0};
  const std::size_t before = testing::allocations.count;
  followers.apply(weights);
  EXPECT_EQ(testing::allocations.count, before);
}

}  // namespace
}  // namespace sweepface
