#include "rig/number.hpp"

#include <clocale>
#include <gtest/gtest.h>
#include <string>

namespace sweepface {
namespace {

TEST(Number, isAllOfATextOrNothing) {
  EXPECT_EQ(numberOf("0.5"), 0.5);
  EXPECT_EQ(numberOf("-1e-3"), -0.001);
  EXPECT_EQ(numberOf("7."), 7);
  EXPECT_EQ(numberOf("+1"), 1);
  for (const char* text :
       {"", "+-1", "1 ", " 1", "1,5", "0x10", "1e", "-", "inf", "nan", "1e999", "1.2.3"})
    EXPECT_FALSE(numberOf(text)) << text;
}

TEST(Number, hasAPointInEveryLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8") && !std::setlocale(LC_NUMERIC, "fr_FR.UTF-8"))
    GTEST_SKIP() << "no locale with a comma is installed";
  EXPECT_EQ(numberOf("0.5"), 0.5);
  std::setlocale(LC_NUMERIC, before.c_str());
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
