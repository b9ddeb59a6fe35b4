#include "rig/number.hpp"

#include <clocale>
#include <gtest/gtest.h>
#include <locale>

namespace sweepface {
namespace {

TEST(Number, isAllOfATextOrNothing) {
  EXPECT_EQ(numberOf("0.5"), 0.5);
  EXPECT_EQ(numberOf("-1e-3"), -0.001);
  EXPECT_EQ(numberOf("7."), 7);
  for (const char* text :
       {"", "+1", "1 ", " 1", "1,5", "0x10", "1e", "-", "inf", "nan", "1e999", "1.2.3"})
    EXPECT_FALSE(numberOf(text)) << text;
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Number, hasAPointInEveryLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  EXPECT_EQ(numberOf("0.5"), 0.5);
  std::locale::global(before);
}

TEST(List, isTakenApartAtCommas) {
  std::string_view list = " a = 1 ,,b";
  EXPECT_EQ(takeItem(list), "a = 1");
  EXPECT_EQ(takeItem(list), "");
  EXPECT_EQ(takeItem(list), "b");
  EXPECT_TRUE(list.empty());
}

}  // namespace
}  // namespace sweepface
