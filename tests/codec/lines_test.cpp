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

// 16 x 16 quads: every node is a site of the same number.
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

// A tube: a ring of `around` patches.
Wireframe tube(Index around) {
  Wireframe w;
  w.points = 2 * around;
  for (Index n = 0; n < w.points; ++n) w.nodes.push_back({n, kPosition});
  for (Index level = 0; level < 2; ++level)
    for (Index k = 0; k < around; ++k)
      w.arcs.push_back({level * around + k, level * around + (k + 1) % around});
  for (Index k = 0; k < around; ++k) w.arcs.push_back({k, around + k});
  for (Index k = 0; k < around; ++k) {
    const auto first = static_cast<Index>(w.loops.size());
    w.loops.insert(w.loops.end(), {2 * k, 2 * (2 * around + (k + 1) % around), 2 * (around + k) + 1,
                                   2 * (2 * around + k) + 1});
    w.patches.push_back({{first, first + 1, first + 2, first + 3, first + 4}});
  }
  w.ribbons.emplace_back();
  return w;
}

TEST(LinesOfARing, EndWhereNothingIsLeft) {
  for (const Index around : {3, 4, 17, 1000}) {
    const Surface surface = Surface::make(tube(around)).value();
    Lines lines(surface);
    for (Index site = 1; site < around; ++site) lines.takeOut(site);
    const Lines::Link once = lines.walk(0);
    EXPECT_EQ(once.node, 0);
    EXPECT_EQ(once.distance, around);
    lines.takeOut(0);
    for (Index arc = 0; arc < around; ++arc) EXPECT_LT(lines.walk(2 * arc).back, 0);
    EXPECT_EQ(lines.walk(2 * around).node, around + 1) << "the other ring is whole";
  }
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
