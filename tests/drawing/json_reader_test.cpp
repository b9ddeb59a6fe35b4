#include "drawing/json_reader.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace sweepface::drawing {
namespace {

double numberIn(const std::string& text) {
  JsonReader in(text);
  const double value = in.number("a number");
  in.finish();
  EXPECT_TRUE(in.ok()) << text << ": " << in.problem();
  return value;
}

std::string textIn(const std::string& text) {
  JsonReader in(text);
  std::string value = in.text("a text");
  in.finish();
  EXPECT_TRUE(in.ok()) << text << ": " << in.problem();
  return value;
}

TEST(JsonNumbers, areTheNearestDoubles) {
  EXPECT_EQ(numberIn("0"), 0);
  EXPECT_TRUE(std::signbit(numberIn("-0")));
  EXPECT_EQ(numberIn(" -12.5e-3\n"), -0.0125);
  EXPECT_EQ(numberIn("1E+2"), 100);
  EXPECT_EQ(numberIn("0.1"), 0.1);
  EXPECT_EQ(numberIn("1.7976931348623157e308"), 1.7976931348623157e308);
}

TEST(JsonNumbers, areRefusedInAnyOtherForm) {
  for (const char* text : {"",     "+1",  ".5",  "1.",       "01",   "-",     "1e",     "1e+",
                           "0x10", "nan", "NaN", "Infinity", "-inf", "1e999", "-1e400", "1..2",
                           "1,2",  "--1", "1 2", "\"1\"",    "1a",   "true"}) {
    JsonReader in(text);
    in.number("a number");
    in.finish();
    EXPECT_FALSE(in.ok()) << text;
    EXPECT_FALSE(in.problem().empty());
  }
}

TEST(JsonTexts, haveTheEscapesOfJson) {
  EXPECT_EQ(textIn(R"("plain")"), "plain");
  EXPECT_EQ(textIn(R"("\"\\\/\b\f\n\r\t")"), "\"\\/\b\f\n\r\t");
  EXPECT_EQ(textIn(R"("\u0041\u00e9\u20AC\ud83d\ude00")"), "A\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(textIn("\"\xC3\xA9\""), "\xC3\xA9");
}

TEST(JsonTexts, tellBreaksFromTabs) {
  for (const auto& [text, says] : {std::pair{"\"a\nb\"", "over the end of its line"},
                                   {"\"a\tb\"", "a tab or another control character"}}) {
    JsonReader in(text);
    in.text("a text");
    EXPECT_NE(in.problem().find(says), std::string::npos) << in.problem();
  }
}

TEST(JsonTexts, areRefusedWhereTheyAreNone) {
  for (const char* text :
       {"\"open", "\"a\nb\"", R"("\x")", R"("\u12")", R"("\u12g4")", R"("\ud800")", R"("\udc00")",
        R"("\ud83dA")", R"("\ud83d\u0041")", "\"\\", "\"\\u", "\"\\ud83d\\u", "'a'", "a", ""}) {
    JsonReader in(text);
    in.text("a text");
    in.finish();
    EXPECT_FALSE(in.ok()) << text;
  }
}

TEST(JsonPlaces, countLinesAndColumnsFromOne) {
  JsonReader in("{\n  \"a\": 1,\n  \"b\": x\n}");
  in.object("an object", [&](const std::string& key, const TextPlace& at) {
    EXPECT_EQ(at.line, key == "a" ? 2u : 3u);
    EXPECT_EQ(at.column, 3u);
    in.number("a number");
  });
  EXPECT_EQ(in.problem(), "a number is expected where there is 'x'");
  EXPECT_EQ(in.problemPlace().line, 3u);
  EXPECT_EQ(in.problemPlace().column, 8u);
}

TEST(JsonObjects, haveEveryMemberOnce) {
  JsonReader in(R"({"a": 1, "b": 2, "a": 3})");
  int members = 0;
  in.object("an object", [&](const std::string&, const TextPlace&) {
    ++members;
    in.number("a number");
  });
  EXPECT_EQ(members, 2);
  EXPECT_EQ(in.problem(), "'a' is given twice");
}

TEST(JsonLists, visitEveryElement) {
  for (const auto& [text, count] :
       std::vector<std::pair<std::string, int>>{{"[]", 0}, {"[ 1 ]", 1}, {"[1,2 , 3]", 3}}) {
    JsonReader in(text);
    int seen = 0;
    in.array("a list", [&] { EXPECT_EQ(in.number("a number"), ++seen); });
    in.finish();
    EXPECT_TRUE(in.ok());
    EXPECT_EQ(seen, count);
  }
}

TEST(JsonLists, areRefusedWhereTheyAreBroken) {
  for (const char* text : {"[", "[1", "[1,", "[1,]", "[,1]", "[1 2]", "[1}", "]", "{}", "[1]]"}) {
    JsonReader in(text);
    in.array("a list", [&] { in.number("a number"); });
    in.finish();
    EXPECT_FALSE(in.ok()) << text;
  }
}

TEST(Json, afterAFailureReadsNothing) {
  JsonReader in("[1, x, 3]");
  int seen = 0;
  in.array("a list", [&] {
    ++seen;
    in.number("a number");
  });
  EXPECT_EQ(seen, 2);
  EXPECT_EQ(in.number("a number"), 0);
  EXPECT_EQ(in.text("a text"), "");
  EXPECT_FALSE(in.flag("a flag"));
  in.refuse({9, 9}, "another problem");
  EXPECT_EQ(in.problem(), "a number is expected where there is 'x'");
}

TEST(Json, passesOverAByteOrderMark) { EXPECT_EQ(numberIn("\xEF\xBB\xBF 7"), 7); }

}  // namespace
}  // namespace sweepface::drawing
