#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

#include "sweepface/clip.hpp"

namespace sweepface {
namespace {

/// A minute of everything that the app records, and of a shape unknown to it.
Clip take(double framesPerSecond = 60) {
  const auto empty = formatLiveLinkCsv({{"jawOpen"}, {0}, {0}});
  Clip clip = *parseLiveLinkCsv(*empty, "empty.csv");
  clip.names.push_back("cheekRaiser");
  clip.times.clear(), clip.weights.clear();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.1, 1);
  for (int f = 0; f < 60 * framesPerSecond; ++f) {
    clip.times.push_back(3725 + f / framesPerSecond);
    for (std::size_t k = 0; k < clip.names.size(); ++k) clip.weights.push_back(uniform(random));
  }
  return clip;
}

TEST(LiveLinkWriter, WhatItWritesIsReadAgain) {
  for (const double rate : {24.0, 29.97, 60.0}) {
    const Clip clip = take(rate);
    const auto text = formatLiveLinkCsv(clip, rate);
    ASSERT_TRUE(text) << text.error().message;
    const auto again = parseLiveLinkCsv(*text, "take.csv", rate);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->names, clip.names);
    EXPECT_EQ(again->weights, clip.weights);
    ASSERT_EQ(again->times.size(), clip.times.size());
    for (std::size_t f = 0; f < clip.times.size(); ++f)
      EXPECT_NEAR(again->times[f], clip.times[f], 0.6e-3 / rate);
    EXPECT_EQ(*formatLiveLinkCsv(*again, rate), *text);
  }
}

TEST(LiveLinkWriter, MinutesMayPassBetweenFrames) {
  const auto text = formatLiveLinkCsv({{"jawOpen"}, {0, 3}, {0, 1}}, 0.001);
  ASSERT_TRUE(text) << text.error().message;
  const auto again = parseLiveLinkCsv(*text, "take.csv", 0.001);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->times, (std::vector<double>{0, 3}));
}

TEST(LiveLinkWriter, RefusesWeightsThatNobodyReadsAgain) {
  for (const double weight : {1e7, std::nan(""), HUGE_VAL}) {
    const auto text = formatLiveLinkCsv({{"jawOpen"}, {0}, {weight}});
    ASSERT_FALSE(text) << weight;
    EXPECT_EQ(
        text.error().message,
        fmt::format("Frame 0 of the clip gives 'JawOpen' the weight {:.6g}, which is no number "
                    "within ±1,000,000.",
                    weight));
  }
}

TEST(LiveLinkWriter, ColumnsAreTheAppsOwn) {
  const auto text = formatLiveLinkCsv(
      {{"browInnerUp_L", "browInnerUp_R", "eyeBlink_R", "cheekRaiser"}, {0}, {0.25, 0.5, 1, 0.75}});
  ASSERT_TRUE(text);
  EXPECT_TRUE(text->starts_with("Timecode,BlendShapeCount,EyeBlinkLeft,EyeLookDownLeft,"));
  const auto clip = parseLiveLinkCsv(*text, "take.csv");
  ASSERT_TRUE(clip);
  EXPECT_EQ(clip->names.size(), 64u);
  const auto weight = [&](std::string_view name) {
    for (std::size_t k = 0; k < clip->names.size(); ++k)
      if (clip->names[k] == name) return clip->weights[k];
    return std::nan("");
  };
  // Other programs get both sides as one column; reading the file here finds each by its own name.
  EXPECT_EQ(weight("BrowInnerUp"), 0.5);
  EXPECT_EQ(weight("browInnerUp_L"), 0.25);
  EXPECT_EQ(weight("browInnerUp_R"), 0.5);
  EXPECT_EQ(weight("EyeBlinkRight"), 1);
  EXPECT_EQ(weight("EyeBlinkLeft"), 0);
  EXPECT_EQ(weight("HeadYaw"), 0);
  EXPECT_EQ(weight("cheekRaiser"), 0.75);
}

TEST(LiveLinkWriter, WritesZeroWithoutASign) {
  const auto text = formatLiveLinkCsv({{"jawOpen"}, {0}, {-0.0}});
  ASSERT_TRUE(text);
  EXPECT_EQ(text->find("-0"), std::string::npos) << *text;
}

TEST(LiveLinkWriter, SidesThatAreAlikeAreOneColumn) {
  const auto text =
      formatLiveLinkCsv({{"cheekPuff_L", "cheekPuff_R"}, {0, 1}, {0.25, 0.25, 0.5, 0.5}});
  ASSERT_TRUE(text);
  EXPECT_EQ(text->find("cheekPuff"), std::string::npos);
}

TEST(LiveLinkWriter, NamesWithoutASideFillBothColumns) {
  const Clip clip{{"eyeBlink", "EyeSquint", "eyeSquintLeft"}, {0}, {0.25, 0.5, 0.75}};
  const auto text = formatLiveLinkCsv(clip);
  ASSERT_TRUE(text);
  const Clip again = *parseLiveLinkCsv(*text, "take.csv");
  for (const std::vector<std::string>& targets :
       {std::vector<std::string>{"eyeBlink_L", "eyeBlink_R", "eyeSquint_L", "eyeSquint_R"},
        std::vector<std::string>{"eyeBlink", "eyeSquint"}}) {
    std::vector<double> before(targets.size()), after(targets.size());
    matchClip(clip, targets).spread(clip, 0, before);
    matchClip(again, targets).spread(again, 0, after);
    EXPECT_EQ(after, before);
    EXPECT_EQ(idleNames(again, matchClip(again, targets)).size(),
              idleNames(clip, matchClip(clip, targets)).size());
  }
}

TEST(LiveLinkWriter, TakesMayPassMidnight) {
  for (const double rate : {29.97, 60.0}) {
    const double midnight = rate < 30 ? 86486.4 : 86400;  // its clock is slower by a thousandth
    const Clip clip{{"jawOpen"}, {midnight - 0.5, midnight, midnight + 0.5}, {0, 0.5, 1}};
    const auto text = formatLiveLinkCsv(clip, rate);
    ASSERT_TRUE(text) << text.error().message;
    const auto again = parseLiveLinkCsv(*text, "take.csv", rate);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(again->times.size(), 3U);
    for (std::size_t f = 0; f < 3; ++f) EXPECT_NEAR(again->times[f], clip.times[f], 0.6e-3 / rate);
  }
  EXPECT_FALSE(formatLiveLinkCsv({{"jawOpen"}, {10, 86410}, {0, 1}}));
  EXPECT_FALSE(formatLiveLinkCsv({{"jawOpen"}, {86399, 130001}, {0, 1}}));
}

TEST(LiveLinkWriter, NamesMayHoldCommas) {
  const auto text = formatLiveLinkCsv({{"lips, upper", "beard"}, {0}, {0.25, 0.5}}, 60);
  ASSERT_TRUE(text);
  const auto again = parseLiveLinkCsv(*text, "take.csv");
  ASSERT_TRUE(again) << again.error().message;
  const auto column = std::ranges::find(again->names, "lips, upper");
  ASSERT_NE(column, again->names.end());
  EXPECT_EQ(again->weights[static_cast<std::size_t>(column - again->names.begin())], 0.25);
}

TEST(LiveLinkWriter, KeepsQuotesInNames) {
  const std::vector<std::string> names{"\"quoted\"", "a \"b\", c", "a\"b", "a\"\"b"};
  const auto text = formatLiveLinkCsv({names, {0}, {0.1, 0.2, 0.3, 0.4}}, 60);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_TRUE(text->contains(",\"a \"\"b\"\", c\",")) << *text;
  const auto again = parseLiveLinkCsv(*text, "again.csv");
  ASSERT_TRUE(again) << again.error().message;
  for (const std::string& name : names)
    EXPECT_NE(std::ranges::find(again->names, name), again->names.end()) << name;
}

TEST(LiveLinkWriter, RefusesWhatTimecodesCannotTell) {
  const auto refuses = [](std::vector<double> times, double rate = 60,
                          std::string name = "jawOpen") {
    const std::vector<double> weights(times.size(), 0.5);
    return !formatLiveLinkCsv({{name}, times, weights}, rate);
  };
  EXPECT_FALSE(refuses({0, 86399.9}));
  EXPECT_TRUE(refuses({}));
  EXPECT_TRUE(refuses({-1}));
  EXPECT_TRUE(refuses({86400}));
  EXPECT_TRUE(refuses({86399.999999}));  // rounds to the start of the next day
  EXPECT_TRUE(refuses({1, 1 + 1e-7}));
  EXPECT_TRUE(refuses({0}, 0));
  EXPECT_TRUE(refuses({0}, 60, "a\nb"));
  for (const char* name : {"timecode", " Timecode", "blendshapecount ", " "})
    EXPECT_TRUE(refuses({0}, 60, name)) << name;
  EXPECT_FALSE(formatLiveLinkCsv({{"beard", "beard "}, {0}, {0, 1}}, 60));
  EXPECT_FALSE(formatLiveLinkCsv({{"beard", "beard"}, {0}, {0, 1}}, 60));
}

}  // namespace
}  // namespace sweepface
