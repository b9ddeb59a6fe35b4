#include "sweepface/laws.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "sweepface/live_motion.hpp"
#include "sweepface/motion.hpp"

#include "count_of.hpp"

namespace sweepface {
namespace {

using testing::countOf;

TEST(EveryLaw, GoesFromZeroToOne) {
  std::set<std::string> names;
  for (const ShownLaw& law : everyLaw()) {
    EXPECT_TRUE(names.insert(law.name).second);
    EXPECT_FALSE(law.use.empty());
    EXPECT_EQ(law.path.at(0).position, 0) << law.name;
    EXPECT_NEAR(law.path.at(2.5).position, 1, 0.02) << law.name;
  }
  for (const TimeLaw law : timeLaws) EXPECT_TRUE(names.contains(std::string(nameOf(law))));
  for (const char* drive : {"linear-force", "spring", "bounce"}) EXPECT_TRUE(names.contains(drive));
}

TEST(EveryLaw, HasACellThatMoves) {
  const std::string svg = lawSheet();
  const std::size_t laws = everyLaw().size();
  EXPECT_EQ(countOf(svg, "<polyline"), 3 * laws);
  EXPECT_EQ(countOf(svg, "<animate "), 3 * laws);
  EXPECT_EQ(countOf(svg, "nan") + countOf(svg, "inf\""), 0u);
  EXPECT_EQ(countOf(svg, "<g "), countOf(svg, "</g>"));
  EXPECT_LT(svg.size(), 100'000u);
}

}  // namespace
}  // namespace sweepface
