#include "fit/images.hpp"

#include <gtest/gtest.h>

namespace sweepface {
namespace {

TEST(Images, NamesSayTheOtherSide) {
  for (const auto& [one, other] : {std::pair{"eyeBlinkLeft", "eyeBlinkRight"},
                                   {"left_brow", "right_brow"},
                                   {"BROW_LEFT", "BROW_RIGHT"},
                                   {"mouthSmile_L", "mouthSmile_R"},
                                   {"lip.l", "lip.r"}}) {
    EXPECT_EQ(otherSide(one), other);
    EXPECT_EQ(otherSide(other), one);
  }
  for (const char* name : {"jawOpen", "L", "XL", ""}) EXPECT_EQ(otherSide(name), name);
}

// Poses compared with the image of another are packed concurrently, so they must not depend on each
// other.
TEST(Images, TheOtherSideOfTheOtherSideIsTheNameItself) {
  for (const char* name : {"RightLookLeft", "LeftLookRight", "rightUpLeft", "LEFT_right_L",
                           "leftLeft", "RIGHT.R", "Left_R"}) {
    EXPECT_NE(otherSide(name), name);
    EXPECT_EQ(otherSide(otherSide(name)), name);
  }
}

}  // namespace
}  // namespace sweepface
