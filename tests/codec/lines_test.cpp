#include "codec/lines.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

#include "codec/near_sites.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using codec::Lines;
using codec::NearSites;

// 16 x 16 quads: each node is a site, numbered as the nodes are.
class LinesOfASheet : public ::testing::Test {
 protected:
  static constexpr Index kRow = 17;
  static Index at(Index x, Index y) { return y * kRow + x; }
  // The half-arc that leads from a node to the right.
  static HalfArc right(Index x, Index y) { return 2 * (y * (kRow - 1) + x); }
  Index endOf(const Lines::Link& link) const { return surface.wireframe().start(link.back); }

  Rig rig = makeRig(sheet(kRow - 1));
  const Surface& surface = rig.surface;
  Lines lines{surface};
};

TEST_F(LinesOfASheet, LeadToTheNextSite) {
  const Lines::Link link = lines.walk(right(4, 8));
  EXPECT_EQ(endOf(link), at(5, 8));
  EXPECT_EQ(link.distance, 1);
  EXPECT_EQ(endOf(lines.beyond(link)), at(6, 8));
  EXPECT_EQ(lines.beyond(link).distance, 2);
}

TEST_F(LinesOfASheet, LeadAcrossWhatWasTakenOut) {
  for (const Index x : {5, 6, 8}) lines.takeOut(at(x, 8));
  const Lines::Link link = lines.walk(right(4, 8));
  EXPECT_EQ(endOf(link), at(7, 8));
  EXPECT_EQ(link.distance, 3);
  EXPECT_EQ(lines.beyond(link).distance, 5);
  EXPECT_EQ(lines.walk(right(4, 9)).distance, 1) << "other lines are as they were";
}

TEST_F(LinesOfASheet, EndAtTheBoundary) {
  const Lines::Link link = lines.walk(right(15, 8));
  EXPECT_EQ(endOf(link), at(16, 8));
  EXPECT_LT(lines.beyond(link).back, 0);
  lines.takeOut(at(16, 8));
  EXPECT_LT(lines.walk(right(15, 8)).back, 0);
}

TEST_F(LinesOfASheet, TellTheNearestSitesFirst) {
  NearSites near(surface, lines);
  const auto found = near.around(at(8, 8), -1);
  ASSERT_EQ(found.size(), 12u) << "4 at a distance of 1, 8 at 2";
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_EQ(std::abs(found[k] % kRow - 8) + std::abs(found[k] / kRow - 8), k < 4 ? 1 : 2);
}

TEST_F(LinesOfASheet, TellNeitherWhatWasTakenOutNorTheImage) {
  lines.takeOut(at(8, 7));
  NearSites near(surface, lines);
  const auto found = near.around(at(8, 8), at(9, 8));
  EXPECT_GE(found.size(), 12u);
  EXPECT_EQ(std::ranges::count(found, at(8, 7)), 0);
  EXPECT_EQ(std::ranges::count(found, at(9, 8)), 0);
  EXPECT_EQ(std::ranges::count(found, at(8, 6)), 1) << "what stands behind is reached";
}

}  // namespace
}  // namespace sweepface
