#include "io/single.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace sweepface::io {
namespace {

TEST(SingleNumbers, FitSinglePrecisionOrNot) {
  EXPECT_TRUE(areSingle(std::vector{3e38, -3e38, 1e-300}));
  EXPECT_FALSE(areSingle(std::vector{1.0, 3.5e38}));
  EXPECT_FALSE(areSingle(std::vector{std::nan("")}));
  EXPECT_FALSE(areSingle(std::vector<Vec3>{{0, -4e38, 0}}));
  EXPECT_FALSE(areSingle(std::vector<Vec2>{{0, 4e38}}));
}

}  // namespace
}  // namespace sweepface::io
