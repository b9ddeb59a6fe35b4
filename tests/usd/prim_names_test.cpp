#include "usd/prim_names.hpp"

#include <gtest/gtest.h>

namespace sweepface::usd {
namespace {

TEST(PrimNames, HoldLettersDigitsAndUnderscores) {
  PrimNames names;
  EXPECT_EQ(names.take("jawOpen_L2"), "jawOpen_L2");
  EXPECT_EQ(names.take("mouth-open"), "mouth_open");
  EXPECT_EQ(names.take("2nd"), "_2nd");
  EXPECT_EQ(names.take(""), "_");
  EXPECT_EQ(names.take("ö"), "__");
}

TEST(PrimNames, AreTakenOnlyOnce) {
  PrimNames names;
  EXPECT_EQ(names.take("a.b"), "a_b");
  EXPECT_EQ(names.take("a b"), "a_b_2");
  EXPECT_EQ(names.take("a_b"), "a_b_3");
  EXPECT_EQ(names.take("a_b_2"), "a_b_2_2");
}

}  // namespace
}  // namespace sweepface::usd
