#include "io/text.hpp"

#include <gtest/gtest.h>

namespace sweepface::io {
namespace {

TEST(InQuotes, ShowsEveryLanguage) {
  EXPECT_EQ(inQuotes("jawOpen"), "'jawOpen'");
  EXPECT_EQ(inQuotes("あ"), "'あ'");
  EXPECT_EQ(inQuotes("улыбка 😀"), "'улыбка 😀'");
}

TEST(InQuotes, CutsBetweenCharacters) {
  EXPECT_EQ(inQuotes(std::string(40, 'a')), "'" + std::string(40, 'a') + "'");
  EXPECT_EQ(inQuotes(std::string(41, 'a')), "'" + std::string(40, 'a') + "...'");
  EXPECT_EQ(inQuotes(std::string(39, 'a') + "é"), "'" + std::string(39, 'a') + "...'");
  EXPECT_EQ(inQuotes(std::string(38, 'a') + "é"), "'" + std::string(38, 'a') + "é'");
}

TEST(InQuotes, JudgesWhatItShows) {
  EXPECT_EQ(inQuotes("é" + std::string(50, 'a') + "\xff"), "'é" + std::string(38, 'a') + "...'");
  EXPECT_EQ(inQuotes(std::string(50, '\x80')), "'" + std::string(40, '?') + "...'");
}

TEST(InQuotes, HidesWhatIsNoText) {
  EXPECT_EQ(inQuotes("a\x1b[31m"), "'a?[31m'");
  EXPECT_EQ(inQuotes("a\x7f"), "'a?'");
  EXPECT_EQ(inQuotes("caf\xe9"), "'caf?'");  // Latin-1
}

}  // namespace
}  // namespace sweepface::io
