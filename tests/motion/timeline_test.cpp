#include "sweepface/timeline.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "sweepface/trajectory.hpp"

#include "greater.hpp"

namespace sweepface {
namespace {

double weight(const Clip& clip, double seconds, std::string_view name) {
  std::vector<double> all(clip.names.size());
  clip.at(seconds, all);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (clip.names[k] == name) return all[k];
  ADD_FAILURE() << "no weight " << name;
  return 0;
}

Clip baked(std::string_view text, double framesPerSecond = 100) {
  const auto timeline = parseTimeline(text, "line.json");
  if (!timeline) {
    ADD_FAILURE() << timeline.error().message;
    return {};
  }
  const auto clip = bake(*timeline, framesPerSecond);
  EXPECT_TRUE(clip);
  return clip.value_or(Clip{});
}

TEST(Timeline, EventsSetOutAtTheirTimes) {
  const Clip clip = baked(R"({"seconds": 3, "events": [
    {"at": 1.5, "to": {"smile": 1}, "drive": "newton", "seconds": 1},
    {"at": 0, "to": {"jawOpen": 0.5}, "drive": "accelerate-brake", "seconds": 1}]})");
  EXPECT_EQ(clip.times.size(), 301u);
  EXPECT_NEAR(weight(clip, 0.5, "jawOpen"), 0.25, 1e-12);
  EXPECT_EQ(weight(clip, 1, "smile"), 0);
  EXPECT_NEAR(weight(clip, 2, "smile"), 0.25, 1e-12);
  EXPECT_EQ(weight(clip, 3, "smile"), 1);
  EXPECT_EQ(weight(clip, 3, "jawOpen"), 0.5);
}

TEST(Timeline, EventsBetweenFramesAreNotRounded) {
  const std::string text =
      R"({"seconds": 1, "events": [{"at": 0.333, "to": {"a": 1}, "drive": "newton"}]})";
  EXPECT_NEAR(weight(baked(text, 10), 0.4, "a"), weight(baked(text, 1000), 0.4, "a"), 1e-12);
}

Baked toPlay(const std::string& text, std::size_t regions = 1) {
  const auto timeline = parseTimeline(text, "line.json");
  if (!timeline) {
    ADD_FAILURE() << timeline.error().message;
    return {};
  }
  return bakeToPlay(*timeline, "rest", {}, regions).value_or(Baked{});
}

std::string swinging(double frequency) {
  return R"({"seconds": 1, "events": [{"at": 0.1, "to": {"a": 1}, "drive": "spring",
             "damping": 0.1, "frequency": )" +
         std::to_string(frequency) + "}]}";
}

double furthestOff(const Clip& clip, double frequency) {
  const auto spring = Trajectory::spring({0, 0}, 1, {frequency, 0.1});
  double most = 0;
  for (double t = 0; t < 1; t += 3e-4)
    most = testing::greater(most, std::abs(weight(clip, t, "a") - spring->at(t - 0.1).position));
  return most;
}

TEST(PlayedTimeline, HasStraightLinesAsGoodAsExactWhereSpringsSwing) {
  for (const double frequency : {2.0, 10.0, 40.0, 1000.0}) {
    const Baked baked = toPlay(swinging(frequency));
    EXPECT_LE(baked.missed, 1e-4);
    EXPECT_LE(furthestOff(baked.clip, frequency), 1.2e-4) << frequency;
  }
}

TEST(PlayedTimeline, HasStraightLinesAsGoodAsExactWhereADriveArrivesBetweenFrames) {
  for (double late = 0.05; late < 1; late += 0.05) {
    const double seconds = (25 + late) / 240;
    const Baked baked =
        toPlay(R"({"seconds": 1, "events": [{"at": 0, "to": {"a": 1}, "drive": "newton",
                   "seconds": )" +
               std::to_string(seconds) + "}]}");
    EXPECT_NEAR(weight(baked.clip, seconds, "a"), 1, 1e-4) << late;
  }
}

TEST(PlayedTimeline, OfALateRegionLastsSoMuchLongerForAll) {
  const Timeline timeline = parseTimeline(swinging(2), "line.json").value();
  const double end = endIn(timeline, "late", {1, 1, 1.5});
  EXPECT_EQ(end, 2.5);
  const Clip clip = bakeToPlay(timeline, "rest", {}, 2, end)->clip;
  EXPECT_EQ(clip.seconds(), end);
  const auto spring = Trajectory::spring({0, 0}, 1, {2, 0.1});
  for (double t = 1; t < end; t += 0.01)
    EXPECT_NEAR(weight(clip, t, "a"), spring->at(t - 0.1).position, 1.2e-4) << t;
}

TEST(PlayedTimeline, LastsUntilWhatIsHeavyHasArrived) {
  const Timeline timeline = parseTimeline(R"({"seconds": 2, "loops": 2, "events": [
      {"at": 0, "to": {"a": 1, "b": 1}, "drive": "cut"},
      {"at": 1, "to": {"a": 0}, "drive": "accelerate-brake", "seconds": 1},
      {"at": 1.5, "to": {"b": 0}, "drive": "newton", "seconds": 1}]})",
                                          "line.json")
                                .value();
  EXPECT_EQ(endIn(timeline, "rest", {}), 4);
  const double end = endIn(timeline, "heavy", {16, 1, 0});
  EXPECT_EQ(end, 4 + 3) << "b is not there elsewhere either";
  const Timeline late = parseTimeline(R"({"seconds": 1, "loops": 3, "events": [
      {"at": 0.5, "to": {"a": 1}, "drive": "newton", "seconds": 0.25, "delay": 1}]})",
                                      "line.json")
                            .value();
  EXPECT_EQ(endIn(late, "heavy", {16, 1, 0}), 2.75 + 0.75) << "in the second loop the last time";
  for (const auto kind :
       {Drive::Kind::newton, Drive::Kind::linearForce, Drive::Kind::accelerateBrake}) {
    const Drive drive{.kind = kind, .seconds = 1, .spring = {}};
    const Timeline once{1, 1, {{0, {{"a", 1}}, false, "", drive}}};
    EXPECT_EQ(endIn(once, "heavy", {16, 1, 0}), 4) << nameOf(kind);
  }
  const Clip clip = bakeToPlay(timeline, "heavy", {16, 1, 0})->clip;
  EXPECT_EQ(clip.seconds(), end);
  EXPECT_GT(weight(clip, end - 1, "a"), 0.05);
  EXPECT_EQ(weight(clip, end, "a"), 0);
}

TEST(PlayedTimeline, SaysWhatItMissesWhereThereIsNoRoom) {
  const Baked baked = toPlay(swinging(40), kMostClipWeights / 400);
  EXPECT_LE(baked.clip.weights.size(), 400u);
  EXPECT_GT(baked.missed, 0.05);
  EXPECT_NEAR(baked.missed, furthestOff(baked.clip, 40), 0.03);
}

TEST(PlayedTimeline, HasNoMoreFramesWhereMoreThanAMillionEventsSetOut) {
  const auto framesOf = [](int loops) {
    Timeline timeline{1e-4, loops, {}};
    const Drive swing{.kind = Drive::Kind::spring, .spring = {40, 0.1}};
    timeline.events.push_back({0, {{"a", 1}}, false, "", swing});
    timeline.events.resize(1000, {0, {}, false, "", {}});
    return bakeToPlay(timeline, "rest", {})->clip.times.size();
  };
  EXPECT_GT(framesOf(1000), 25u);
  EXPECT_EQ(framesOf(1001), 26u);
}

TEST(PlayedTimeline, SaysWhatItMissesOfSpringsQuickerThanItsFrames) {
  EXPECT_GT(toPlay(swinging(1e5)).missed, 0.05);
  EXPECT_LE(toPlay(swinging(1e8)).missed, 1e-4) << "it is there within a frame, as a jump is";
}

TEST(PlayedTimeline, SaysWhatItMissesOfSpringsThatDoNotOvershoot) {
  for (const double frequency : {1500.0, 3000.0, 20000.0}) {
    const Baked baked = toPlay(R"({"seconds": 1, "events": [{"at": 0.1, "to": {"a": 1},
                                   "drive": "spring", "frequency": )" +
                               std::to_string(frequency) + "}]}");
    const auto spring = Trajectory::spring({0, 0}, 1, {frequency, 1});
    double most = 0;
    for (double t = 0; t < 20 / frequency; t += 0.01 / frequency)
      most = std::max(most, std::abs(weight(baked.clip, 0.1 + t, "a") - spring->at(t).position));
    EXPECT_GT(most, 1e-4) << frequency;
    EXPECT_NEAR(baked.missed, most, 0.4 * most) << frequency;
  }
}

TEST(PlayedTimeline, HasNoMoreFramesWhereNothingSwings) {
  const Baked baked = toPlay(R"({"seconds": 2, "events": [
    {"at": 0.5, "to": {"a": 1}, "drive": "accelerate-brake", "seconds": 1},
    {"at": 1.777, "to": {"a": 0}, "drive": "cut"}]})");
  EXPECT_LT(baked.clip.times.size(), 500u);
  EXPECT_LE(baked.missed, 1e-4) << "a jump is meant";
}

TEST(Timeline, OnlySendsEverythingElseToRest) {
  const Clip clip = baked(R"({"seconds": 2,
    "poses": {"grin": {"smile": 1}, "gape": {"jawOpen": 1}},
    "events": [{"at": 0, "to": "grin", "drive": "cut"},
               {"at": 1, "only": "gape", "drive": "cut"}]})");
  EXPECT_EQ(weight(clip, 0.5, "smile"), 1);
  EXPECT_EQ(weight(clip, 1.5, "smile"), 0);
  EXPECT_EQ(weight(clip, 1.5, "jawOpen"), 1);
}

TEST(Timeline, LoopsGoOnFromWhereTheyAre) {
  const Clip clip = baked(R"({"seconds": 1, "loops": 3, "events": [
    {"at": 0, "to": {"a": 1}, "drive": "cut"}, {"at": 0.5, "to": {"a": 0}, "drive": "cut"}]})");
  EXPECT_EQ(clip.seconds(), 3);
  EXPECT_EQ(weight(clip, 2.25, "a"), 1);
  EXPECT_EQ(weight(clip, 2.75, "a"), 0);
}

TEST(Timeline, EndsWhereItSaysThatItEnds) {
  const Clip clip = baked(R"({"seconds": 1.002, "events": [
    {"at": 1.0015, "to": {"a": 1}, "drive": "cut"}]})");
  EXPECT_EQ(clip.times.back(), 1.002);
  EXPECT_EQ(weight(clip, 1.002, "a"), 1);
  EXPECT_EQ(weight(clip, 1, "a"), 0);
}

TEST(Timeline, HoldsNoMoreWeightsThanAClipMay) {
  std::string goals;
  for (int k = 0; k < 100; ++k) goals += (k > 0 ? ",\"n" : "\"n") + std::to_string(k) + "\": 1";
  const auto timeline = parseTimeline(
      R"({"seconds": 9000, "events": [{"at": 0, "to": {)" + goals + "}}]}", "line.json");
  ASSERT_TRUE(timeline) << timeline.error().message;
  const auto clip = bake(*timeline, 100);
  ASSERT_FALSE(clip);
  EXPECT_NE(clip.error().message.find("more weights than a clip can hold"), std::string::npos);
}

// Many events at the same instant, repeated in a very short loop.
TEST(Timeline, SendsWeightsOffNoMoreOftenThanAClipCanTell) {
  std::string events;
  for (int k = 0; k < 100; ++k)
    events +=
        std::string(k > 0 ? "," : "") + R"({"at": 0, "to": {"n)" + std::to_string(k) + R"(": 1}})";
  const auto timeline = parseTimeline(
      R"({"seconds": 0.001, "loops": 10000, "events": [)" + events + "]}", "line.json");
  ASSERT_TRUE(timeline) << timeline.error().message;
  const auto clip = bake(*timeline, 100);
  ASSERT_FALSE(clip);
  EXPECT_NE(clip.error().message.find("repeat it less"), std::string::npos) << clip.error().message;
}

TEST(Timeline, HasItsEventsInTheOrderOfTheirTimes) {
  const auto refusal = [](std::vector<double> times, double seconds = 2, int loops = 1) {
    Timeline timeline{seconds, loops, {}};
    for (const double time : times) timeline.events.push_back({time, {{"a", 1}}, false, {}, {}});
    const auto clip = bake(timeline, 60);
    return clip ? "" : clip.error().message;
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({0, 0, 0.5, 2}, 2, 3), "");
  const auto outOfOrder = [](int event) {
    return "Event " + std::to_string(event) +
           " of the timeline is before another or beyond the end; the events stand in the order of "
           "their times.";
  };
  EXPECT_EQ(refusal({1, 0.5}), outOfOrder(1));
  for (const double time : {-1.0, 2.1, std::nan("")}) EXPECT_EQ(refusal({time}), outOfOrder(0));
  for (const std::string& message : {refusal({}, -1), refusal({0}, 2, 0)})
    EXPECT_EQ(message, "A timeline lasts longer than 0 seconds and is played once at least.");
}

TEST(Timeline, IsToldFromACaptureByItsOwnKeys) {
  EXPECT_TRUE(isTimeline(R"({"events": []})"));
  EXPECT_TRUE(isTimeline("{\"a\": {\"events\": 1}, \"events\"\n :[]}"));
  EXPECT_FALSE(isTimeline(R"([{"events": []}])"));
  EXPECT_FALSE(isTimeline(R"({"frames": [{"events": []}]})"));
  EXPECT_FALSE(isTimeline(R"({"facsNames": ["events"], "a": "events"})"));
  EXPECT_FALSE(isTimeline(R"({"a": "\"events\":"})"));
  EXPECT_FALSE(isTimeline("{\"events\""));
}

void expectError(std::string_view text, std::string_view part) {
  const auto timeline = parseTimeline(text, "line.json");
  ASSERT_FALSE(timeline) << text;
  EXPECT_NE(timeline.error().message.find(part), std::string::npos) << timeline.error().message;
}

TEST(Timeline, SaysWhatIsWrongAndWhere) {
  expectError("", "line.json, line 1: this is not JSON; was the file cut short?");
  expectError("{\n\"seconds\": 1,\n\"events\": [}",
              "line.json, line 3: this is not JSON, at column 12: '}'.");
  expectError(R"({"seconds": 1, "seconds": 2})", "line.json has the key 'seconds' twice");
  expectError(R"({"seconds": 1e999})", "line.json has a number that is too large to be held.");
  expectError("\xfe\xff", "line.json is a text in UTF-16; save it in UTF-8.");
  expectError("[]", "is not an object");
  expectError(R"({"events": []})", "has no 'seconds'");
  expectError(R"({"seconds": 0, "events": [1]})", "'seconds' must be greater than 0");
  expectError(R"({"seconds": 1, "poses": [1], "events": [{"at": 0, "to": {}}]})",
              "'poses' are not an object");
  expectError(R"({"seconds": 1})", "'events' must be a list");
  expectError(R"({"seconds": 1, "loops": 1.5, "events": [1]})", "'loops'");
  expectError(R"({"seconds": 1, "evnts": []})", "unknown key 'evnts'");
  const auto event = [](std::string inside) {
    return R"({"seconds": 1, "poses": {"p": {"a": 1}}, "events": [)" + inside + "]}";
  };
  expectError(event("1"), "events[0] is not an object");
  expectError(event(R"({"to": {}})"), "events[0] has no 'at'");
  expectError(event(R"({"at": 0})"), "one of 'to' and 'only'");
  expectError(event(R"({"at": 0, "to": {}, "only": {}})"), "one of 'to' and 'only'");
  expectError(event(R"({"at": 0, "to": "nobody"})"), "a pose 'nobody'");
  expectError(R"({"seconds": 1, "poses": {"q": 1}, "events": [{"at": 0, "to": {}}]})",
              "pose 'q' is not an object");
  expectError(R"({"seconds": 1, "poses": {"q": {"a": 1e9}}, "events": [{"at": 0, "to": {}}]})",
              "pose 'q' has a weight 'a' that is not a number within ±1,000,000");
  expectError(event(R"({"at": 0, "to": {"a": "b"}})"), "a weight 'a' that is not a number");
  expectError(event(R"({"at": 0, "to": {"a": 1e9}})"), "not a number within ±1,000,000");
  expectError(event(R"({"at": 0, "to": "p", "drive": "jump"})"), "accelerate-brake");
  expectError(event(R"({"at": 0, "to": "p", "speed": 3})"), "unknown key 'speed'");
  expectError(event(R"({"at": 0, "to": "p", "delay": -1})"), "'delay'");
  expectError(event(R"({"at": 0, "to": "p", "drive": "newton", "seconds": 0})"),
              "events[0] cannot");
  expectError(event(R"({"at": -1, "to": "p"})"), "before 0");
  expectError(R"({"seconds": 1, "regions": 5, "events": [{"at": 0, "to": {"a": 1}}]})",
              "'regions' are not a list");
  expectError(event(R"({"at": 2, "to": "p"})"), "events[0] is later than 'seconds'");
  expectError(event(R"({"at": 0.5, "to": "p", "delay": 0.6})"),
              "events[0] has a 'delay' that leads beyond the end");
  expectError(event(R"({"at": 0, "to": "p", "seconds": 1.5})"),
              "has a 'seconds', which the drive 'spring' has no use for");
  expectError(event(R"({"at": 0, "to": "p", "drive": "cut", "seconds": 1})"), "'seconds'");
  expectError(event(R"({"at": 0, "to": "p", "drive": "newton", "turn": 0.5})"), "'turn'");
  expectError(event(R"({"at": 0, "to": "p", "drive": "newton", "damping": 1})"), "'damping'");
  expectError(event(R"({"at": 0, "to": "p", "restitution": 0.5})"), "'restitution'");
}

TEST(Timeline, MayHoldWhatSetsOutAtItsVeryEnd) {
  EXPECT_TRUE(parseTimeline(R"({"seconds": 0.3, "events": [{"at": 0.1, "delay": 0.2, "to": {}}]})",
                            "line.json"));
}

TEST(Timeline, HoldsNoMoreGoalsThanAnyoneDraws) {
  const auto readWith = [](int events) {
    std::string text = R"({"seconds": 1, "poses": {"all": {"0": 0)";
    for (int k = 1; k < 2000; ++k) text += ",\"" + std::to_string(k) + "\": 0";
    text += R"(}}, "events": [{"at": 0, "to": "all"})";
    for (int k = 1; k < events; ++k) text += R"(,{"at": 0, "to": "all"})";
    return parseTimeline(text + "]}", "line.json");
  };
  EXPECT_TRUE(readWith(4000));
  const auto refused = readWith(4001);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("events[4000] is beyond the 8,000,000 goals"),
            std::string::npos)
      << refused.error().message;
}

TEST(Timeline, HasOneToAMillionFrames) {
  const auto refusal = [](double framesPerSecond) {
    const auto clip = bake(Timeline{1, 1, {}}, framesPerSecond);
    return clip ? "" : clip.error().message;
  };
  EXPECT_EQ(refusal(2e-6), "");
  EXPECT_EQ(refusal(1e6), "");
  EXPECT_EQ(refusal(5e-7),
            "A timeline must last longer than a millionth of a frame; make it longer.");
  for (const double framesPerSecond : {0.0, -1.0, std::nan(""), 1e6 + 1, 1e9})
    EXPECT_EQ(refusal(framesPerSecond).find("A timeline has 1 to 1,000,000 frames"), 0u)
        << framesPerSecond;
}

}  // namespace
}  // namespace sweepface
