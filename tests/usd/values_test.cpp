#include "usd/values.hpp"

#include <gtest/gtest.h>

namespace sweepface::usd {
namespace {

TEST(Texts, AreInTheQuotesThatTheyDoNotHave) {
  EXPECT_EQ(inQuotes("skin"), R"("skin")");
  EXPECT_EQ(inQuotes("it's"), R"("it's")");
  EXPECT_EQ(inQuotes(R"(a "smile")"), R"('a "smile"')");
  EXPECT_EQ(inQuotes(R"(it's "so")"), R"("it's \"so\"")");
  EXPECT_EQ(inQuotes("back\\slash"), R"("back\\slash")");
}

TEST(Texts, EscapeWhatEndsLinesAndReplaceWhatIsNotUtf8) {
  EXPECT_EQ(inQuotes("two\nlines\x7F"), R"("two\x0alines\x7f")");
  EXPECT_EQ(inQuotes("Öl"), "\"Öl\"");
  EXPECT_EQ(inQuotes("\xD6l"), "\"\uFFFDl\"");
}

TEST(Numbers, AreAsShortAsSinglePrecisionAllows) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(1.0 / 3), "0.33333334");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(16777217), "16777216");
  EXPECT_EQ(tuple(std::array{1.0, 0.5, -2.0}), "(1, 0.5, -2)");
}

TEST(Lists, HaveCommasBetween) {
  EXPECT_EQ(list(std::vector<Index>{}), "[]");
  EXPECT_EQ(list(std::vector<Index>{3, -1}), "[3, -1]");
  EXPECT_EQ(list(std::vector<std::string>{"a", "b"}), R"(["a", "b"])");
  EXPECT_EQ(list(std::vector<Vec2>{{0, 1}, {0.25, 2}}), "[(0, 1), (0.25, 2)]");
  EXPECT_EQ(list(std::vector<Vec3>{{1, 2, 3}}), "[(1, 2, 3)]");
}

}  // namespace
}  // namespace sweepface::usd
