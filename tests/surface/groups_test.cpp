#include "surface/groups.hpp"

#include <gtest/gtest.h>

namespace sweepface {
namespace {

std::vector<Index> listed(std::span<const Index> group) { return {group.begin(), group.end()}; }

TEST(Groups, HoldTheNumbersOfTheirKeyInAscendingOrder) {
  const std::vector<Index> keys{2, 0, 2, -1, 4, 0, 2};
  const Groups groups(keys, 5);
  EXPECT_EQ(listed(groups.of(0)), (std::vector<Index>{1, 5}));
  EXPECT_TRUE(groups.of(1).empty());
  EXPECT_EQ(listed(groups.of(2)), (std::vector<Index>{0, 2, 6}));
  EXPECT_TRUE(groups.of(3).empty());
  EXPECT_EQ(listed(groups.of(4)), (std::vector<Index>{4})) << "what has no key is in none";
}

TEST(Groups, MayAllBeEmpty) {
  EXPECT_TRUE(Groups({}, 1).of(0).empty());
  EXPECT_TRUE(Groups(std::vector<Index>{-1, -1}, 2).of(1).empty());
}

}  // namespace
}  // namespace sweepface
