#include "sweepface/regional_clips.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace sweepface {
namespace {

const std::vector<std::string> kNames{"rest", "cheeks"};
const std::vector<Matter> kMatters{{}, {4, 1, 0.5}};

Timeline timelineOf(std::string_view text) { return parseTimeline(text, "line.json").value(); }

Clip captureOf(std::size_t frames, std::size_t names) {
  Clip clip;
  clip.names.resize(names);
  for (std::size_t f = 0; f < frames; ++f) clip.times.push_back(static_cast<double>(f) / 60);
  clip.weights.resize(frames * names, 1);
  return clip;
}

TEST(RegionalClips, OfACaptureAreItInEveryMatter) {
  Clip capture = captureOf(60, 1);
  for (std::size_t f = 0; f < 30; ++f) capture.weights[f] = 0;
  const Spring hold{3, 0.5};
  const RegionalClips clips = inRegions(capture, kMatters, hold).value();
  EXPECT_EQ(clips.whole.weights, capture.weights);
  ASSERT_EQ(clips.ofRegions.size(), 2u);
  EXPECT_EQ(clips.ofRegions[0].weights, capture.weights);
  EXPECT_EQ(clips.ofRegions[1].weights, inMatter(capture, kMatters[1], hold, 2).weights);
  EXPECT_EQ(clips.missed, 0);
}

TEST(RegionalClips, HoldNoMoreInAllThanOneMay) {
  const std::vector<Matter> matters(1024);
  const Clip capture = captureOf(kMostClipWeights / matters.size() / 64 + 1, 64);
  EXPECT_TRUE(inRegions(capture, {kMatters.data(), 1}, {}));
  EXPECT_FALSE(inRegions(capture, {}, {}));
  const auto refused = inRegions(capture, matters, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "it is too long for 1024 regions; cut it, or play it with fewer.");
}

TEST(RegionalClips, ShareTheRoomHoweverMuchSwings) {
  Clip rise = captureOf(2, 64);
  std::fill_n(rise.weights.begin(), 64, 0.0);
  const Matter heavy{4, 1, 0};
  const Spring hold{3, 0.05};
  std::vector<Matter> matters(2000);
  matters.back() = heavy;
  const std::size_t share = kMostClipWeights / matters.size();
  EXPECT_GT(inMatter(rise, heavy, hold).weights.size(), share) << "alone";
  EXPECT_LE(inRegions(rise, matters, hold)->ofRegions.back().weights.size(), share);
}

TEST(RegionalClips, AreRefusedWhereMattersOrSpringsAreNone) {
  const Clip capture = captureOf(2, 1);
  const Timeline timeline = timelineOf(R"({"seconds": 2, "events": [{"at": 0, "to": {"a": 1}}]})");
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const Matter& bad :
       {Matter{kNone, 1, 0}, {-3, 1, 0}, {1, 1, -1}, {1, 1, kNone}, {1, 0, 0}}) {
    const std::vector<Matter> matters{{}, bad};
    EXPECT_EQ(inRegions(capture, matters, {}).error().message, check(bad).error().message);
    EXPECT_EQ(inRegions(timeline, kNames, matters).error().message, check(bad).error().message);
  }
  for (const Spring& hold : {Spring{0, 1}, {kNone, 1}, {2, -1}}) {
    const auto refused = inRegions(capture, kMatters, hold);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().message.starts_with("the spring on which heavy regions hang: "));
  }
}

TEST(RegionalClips, OfATimelineEndTogether) {
  const RegionalClips clips = inRegions(timelineOf(R"({"seconds": 1, "events": [
      {"at": 0, "to": {"a": 1}, "drive": "newton", "seconds": 1}]})"),
                                        kNames, kMatters)
                                  .value();
  ASSERT_EQ(clips.ofRegions.size(), 2u);
  EXPECT_EQ(clips.ofRegions[0].seconds(), 2.5) << "twice as long, and half a second late";
  EXPECT_EQ(clips.ofRegions[1].seconds(), 2.5);
  EXPECT_EQ(clips.whole.weights, clips.ofRegions[0].weights);
}

TEST(RegionalClips, OfATimelineMissAsMuchAsTheWorst) {
  const Timeline timeline = timelineOf(R"({"seconds": 1, "events": [
      {"at": 0, "to": {"a": 1}, "drive": "newton", "seconds": 1},
      {"at": 0, "to": {"a": 1}, "drive": "spring", "frequency": 40, "region": "cheeks"}]})");
  EXPECT_FALSE(inRegions(timeline, {}, {}));
  EXPECT_FALSE(inRegions(timeline, kNames, {kMatters.data(), 1}));
  EXPECT_EQ(inRegions(timeline, kNames, kMatters)->missed,
            bakeToPlay(timeline, "cheeks", kMatters[1], 2, 2.5)->missed);
}

TEST(RegionalClips, TurnHeadsAtOnceWhereEvenTheFirstRegionIsHeavy) {
  const Timeline timeline = timelineOf(R"({"seconds": 1, "events": [
      {"at": 0, "to": {"HeadYaw": 1}, "drive": "linear-force", "seconds": 1}]})");
  const std::vector<Matter> heavy{{4, 1, 0}, {4, 1, 0}};
  const RegionalClips clips = inRegions(timeline, kNames, heavy).value();
  const auto yawAt = [](const Clip& clip, double seconds) {
    return clip.weight(clip.momentAt(seconds), 0);
  };
  EXPECT_EQ(yawAt(clips.whole, 1), 1);
  EXPECT_NEAR(yawAt(clips.ofRegions[0], 1), 0.5, 1e-4);
}

TEST(RegionalClips, AreRefusedWhereAnEventIsForARegionThatThereIsNot) {
  const auto refused = inRegions(timelineOf(R"({"seconds": 1, "events": [
      {"at": 0, "to": {"a": 1}, "drive": "newton", "region": "nose"}]})"),
                                 kNames, kMatters);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "an event is for a region 'nose' that there is not; there is rest, cheeks.");
}

}  // namespace
}  // namespace sweepface
