#include <gtest/gtest.h>
#include <string>

#include "sweepface/clip.hpp"

namespace sweepface {
namespace {

Result<Clip> csv(std::string_view text) { return parseLiveLinkCsv(text, "take.csv"); }
Result<Clip> json(std::string_view text) { return parseClipJson(text, "take.json"); }

void expectError(const Result<Clip>& clip, std::string_view part) {
  ASSERT_FALSE(clip);
  EXPECT_NE(clip.error().message.find(part), std::string::npos) << clip.error().message;
}

TEST(LiveLinkCsv, IsReadByItsHeadings) {
  const auto clip =
      csv("Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen\n"
          "15:52:36:30.000,2,0.25,0.5\r\n"
          "15:52:36:33.500,2,0.75,-0.1\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"EyeBlinkLeft", "JawOpen"}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0.25, 0.5, 0.75, -0.1}));
  EXPECT_NEAR(clip->seconds(), 3.5 / 60, 1e-10);
  EXPECT_EQ(clip->times[0], (15 * 60 + 52) * 60 + 36.5);
}

TEST(LiveLinkCsv, OrderCaseAndMarksOfHeadingsDoNotMatter) {
  const auto clip = csv("\xef\xbb\xbfjawOpen,BlendshapeCount,timecode\n1,52,0.5\n\n0,52,1\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, std::vector<std::string>{"jawOpen"});
  EXPECT_EQ(clip->times, (std::vector<double>{0.5, 1}));
}

TEST(LiveLinkCsv, LinesMayEndInReturnsAlone) {
  const auto clip = csv("Timecode,jawOpen\r0.5,1\r1,0\r");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->weights, (std::vector<double>{1, 0}));
  expectError(csv("Timecode,a\r1,x\r"), "line 2: 'x' in column 2");
}

TEST(LiveLinkCsv, AnyRateOfFrames) {
  EXPECT_NEAR(parseLiveLinkCsv("Timecode,a\n0:0:0:12,1\n", "x", 24)->times[0], 0.5, 1e-15);
}

/// Every `step`th frame from `first` up to `last` of a take that counts `rate` frames a second.
std::string frames(int rate, double first, double last, double step = 1) {
  std::string text = "Timecode,a\n";
  for (double f = first; f < last; f += step) {
    const int second = static_cast<int>(f) / rate;
    text += "1:02:0" + std::to_string(second) + ":" + std::to_string(f - second * rate) + ",0\n";
  }
  return text;
}

/// Three and a half seconds, starting in the middle of a second.
std::string take(int rate, double step = 1) { return frames(rate, rate / 2, 4 * rate, step); }

TEST(LiveLinkCsv, TellsItsRateWhereWholeSecondsAreThere) {
  for (const int rate : {24, 25, 30, 48, 50, 60})
    EXPECT_NEAR(csv(take(rate))->seconds(), (4 * rate - rate / 2 - 1.0) / rate, 1e-9) << rate;
  EXPECT_NEAR(csv(take(30, 0.5))->seconds(), 3.5 - 0.5 / 30, 1e-9) << "60 rows a second";
  EXPECT_NEAR(csv(take(60, 2))->seconds(), 3.5 - 2.0 / 60, 1e-9) << "30 rows a second";
  // The first second is whole if it starts at frame 0; the last one may have been cut short.
  for (const int rate : {24, 25, 30, 48, 50}) {
    EXPECT_NEAR(csv(frames(rate, 0, 2 * rate))->seconds(), 2 - 1.0 / rate, 1e-9) << rate;
    EXPECT_NEAR(csv(frames(rate, 1, 2 * rate))->seconds(), 1 + (rate - 2) / 60., 1e-9) << rate;
  }
  // Too few rows do not determine the rate, nor do rows of less than a second.
  EXPECT_NEAR(csv(frames(24, 0, 48, 2))->seconds(), 1 + 22 / 60., 1e-9) << "12 rows a second";
  EXPECT_NEAR(csv("Timecode,a\n0:0:0:0,0\n0:0:1:15,0\n0:0:2:0,0\n")->times[1], 1.25, 1e-12);
  EXPECT_NEAR(csv("Timecode,a\n0:0:0:0,0\n0:0:0:15,0\n")->times[1], 0.25, 1e-12);
  EXPECT_NEAR(
      parseLiveLinkCsv(take(30), "x", 60)->times[1] - parseLiveLinkCsv(take(30), "x", 60)->times[0],
      1.0 / 60, 1e-9)
      << "what is given counts";
}

TEST(LiveLinkCsv, WarnsOfARateThatItsTimecodesContradict) {
  const auto warnings = [](int counted, double given) {
    return parseLiveLinkCsv(take(counted), "take.csv", given).value().warnings;
  };
  EXPECT_EQ(warnings(30, 60), std::vector<std::string>{"take.csv: 60 frames a second were asked "
                                                       "for, but its timecodes seem to count 30."});
  EXPECT_EQ(warnings(24, 29.97).size(), 1u);
  for (const auto& [counted, given] :
       {std::pair(30, 30.0), std::pair(30, 29.97), std::pair(60, 59.94), std::pair(60, 120.0)})
    EXPECT_TRUE(warnings(counted, given).empty()) << counted << ' ' << given;
  std::string seconds = "Timecode,a\n";  // without frame numbers
  for (int row = 0; row < 120; ++row) seconds += std::to_string(row / 30) + ",0\n";
  EXPECT_EQ(parseLiveLinkCsv(seconds, "take.csv", 60).value().warnings.size(), 1u) << "same times";
}

TEST(LiveLinkCsv, OfRowsAtTheSameTimeTheLastCounts) {
  const auto clip = csv("Timecode,a,b\n1,0,9\n2,1,8\n2,2,7\n2,3,6\n3,4,5\n3,5,4\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->times, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 9, 3, 6, 5, 4}));
  EXPECT_EQ(clip->warnings, std::vector<std::string>{
                                "take.csv: 3 of 6 rows, the first in line 4, have the timecode "
                                "of the one before; of each time the last row counts."});
}

TEST(LiveLinkCsv, LeavesOutARowThatARecorderStoppedIn) {
  const std::string whole = "Timecode,a,b\n1,2,3\n2,4,5";
  for (const std::string half : {"\n3", "\n3,", "\n3,6", "\n3,6,", "\r\n3,", "\n3,6,-", "\n3,6,1e-",
                                 "\n3,6,.", "\n3,6,\"0.5"}) {
    const auto clip = csv(whole + half);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->times, (std::vector<double>{1, 2}));
    EXPECT_EQ(clip->weights, (std::vector<double>{2, 3, 4, 5}));
    EXPECT_EQ(clip->warnings, std::vector<std::string>{
                                  "take.csv: the last row, line 4, is cut short and left out."});
  }
  EXPECT_TRUE(csv(whole)->warnings.empty());
  // A bad last row is an error if it ends in a line break, was not cut short, or is the only row.
  expectError(csv(whole + "\n3,6\n"), "line 4: there are 2 values under 3 headings");
  expectError(csv(whole + "\n3,6\n  "), "line 4: there are 2 values under 3 headings");
  expectError(csv(whole + "\n3,6,x"), "'x' in column 3");
  expectError(csv(whole + "\n3,6,7,8"), "line 4: there are 4 values under 3 headings");
  expectError(csv("Timecode,a,b\n1,2"), "line 2: there are 2 values under 3 headings");
}

TEST(LiveLinkCsv, MayComeFromASpreadsheet) {
  const auto clip =
      csv("\xef\xbb\xbfsep=,\n\"Timecode\",\"JawOpen\", \"a b\" "
          ",\n\"0:0:0;30\",\"0.5\",1,\n0:0:1;0,0,0,\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"JawOpen", "a b"}));
  EXPECT_EQ(clip->times, (std::vector<double>{0.5005, 1.001}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 1, 0, 0}));
  expectError(csv("Timecode;a\n1;0,5\n"), "line 1: the columns are separated by semicolons; save");
  expectError(csv("Timecode\ta\n1\t0\n"),
              "the columns are separated by tabs; save them with commas");
  expectError(csv("Timecode,a,\n1,0,2\n"), "there are 3 values under 2 headings");
}

TEST(LiveLinkCsv, CellsInQuotesMayHoldCommasAndQuotes) {
  const auto clip = csv("Timecode,jawOpen,\"a, \"\"b\"\"\"\n\"00:00:01:00\" , \"0.5\" ,\"2\"\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names.size(), 2u);
  EXPECT_EQ(clip->names[1], "a, \"b\"");
  EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 2}));
  expectError(
      csv("Timecode,jawOpen\n0,\"0,5\"\n"),
      "'0,5' in column 2, 'jawOpen', is not a number within ±1,000,000; take the column out");
}

// Drop-frame timecode counts 29.97 frames a second as 30; the numbers it skips keep it in step with
// the time of day.
TEST(LiveLinkCsv, DroppedFrameNumbersAreNoGap) {
  for (const int rate : {30, 60}) {
    std::string text = "Timecode,jawOpen\n";
    // Through the starts of minutes 9, 10 and 11; minute 10 drops no numbers.
    for (int minute = 8; minute < 12; ++minute)
      for (int second = 0; second < 60; ++second)
        for (int frame = minute % 10 && second == 0 ? rate / 15 : 0; frame < rate; ++frame)
          text += "01:" + std::to_string(minute) + ":" + std::to_string(second) + ";" +
                  std::to_string(frame) + ",0\n";
    for (const double asked : {0.0, rate / 1.001, static_cast<double>(rate)}) {
      const auto clip = parseLiveLinkCsv(text, "take.csv", asked);
      ASSERT_TRUE(clip) << clip.error().message;
      ASSERT_EQ(clip->times.size(), static_cast<std::size_t>(4 * 60 * rate - 3 * rate / 15));
      for (std::size_t f = 1; f < clip->times.size(); ++f)
        EXPECT_NEAR(clip->times[f] - clip->times[f - 1], 1.001 / rate, 1e-9) << f;
    }
  }
  const auto hour =
      csv("Timecode,jawOpen\n00:00:00;00,0\n01:00:00;00,1\n23:59:59;29,1\n00:00:00;00,0");
  ASSERT_TRUE(hour) << hour.error().message;
  EXPECT_NEAR(hour->times[1], 3599.9964, 1e-9);  // 107,892 frames
  EXPECT_GT(hour->times[3], hour->times[2]) << "past midnight";
}

TEST(LiveLinkCsv, RatesBetweenWholeOnesCountWholeFrames) {
  for (const auto& [rate, counted] :
       {std::pair{29.97, 30}, {59.94, 60}, {23.976, 24}, {47.952, 48}}) {
    std::string text = "Timecode,jawOpen\n";
    for (int f = 0; f < 3 * counted; ++f)
      text += "00:00:" + std::to_string(f / counted) + ":" + std::to_string(f % counted) + ",0\n";
    const auto clip = parseLiveLinkCsv(text, "take.csv", rate);
    ASSERT_TRUE(clip) << clip.error().message;
    for (std::size_t f = 0; f < clip->times.size(); ++f)
      EXPECT_NEAR(clip->times[f], static_cast<double>(f) * 1.001 / counted, 1e-9);
  }
  EXPECT_NEAR(parseLiveLinkCsv("Timecode,a\n00:00:01:05,0", "take.csv", 12.5)->times[0], 1.4,
              1e-12);
}

TEST(LiveLinkCsv, GoesOnPastMidnight) {
  const auto clip = csv("Timecode,a\n23:59:59:30,0\n0:0:0:0,1\n0:0:0:30,2\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->seconds(), 1);
  expectError(csv("Timecode,a\n10:0:0:0,0\n9:59:59:0,1\n"),
              "line 3: the timecode '9:59:59:0' is before the one above; sort");
}

TEST(LiveLinkCsv, SaysWhatIsWrongAndWhere) {
  expectError(csv(""), "is empty");
  expectError(csv(std::string_view("\xff\xfeT\0i\0", 6)), "in UTF-16; save it in UTF-8");
  expectError(csv("JawOpen\n1\n"), "line 1: there is no column 'Timecode'");
  expectError(csv("Timecode\n1\n"), "no column of a shape");
  expectError(csv("Timecode,a\n"), "no frames");
  expectError(csv("Timecode,a,a\n"), "two columns 'a'");
  expectError(csv("Timecode,a,timecode\n"), "two columns 'Timecode'");
  expectError(csv("Timecode,,a\n"), "column 2 has no heading");
  expectError(csv("Timecode,a\n1,2,3\n"), "line 2: there are 3 values under 2 headings");
  expectError(csv("Timecode,a\n1\n"), "there are 1 values under 2 headings");
  expectError(csv("Timecode,a\n1,nan\n"), "'nan' in column 2, 'a', is not a number");
  expectError(csv("Timecode,a\n1,1e7\n"),
              "'1e7' in column 2, 'a', is not a number within ±1,000,000");
  expectError(csv("Timecode,a\n1,x\n"), "'x' in column 2");
  expectError(csv("Timecode,a\n1,\n"), "'' in column 2");
  expectError(csv("Timecode,a\n2,0\n1,0\n"), "line 3: the timecode '1' is before the one above");
  expectError(csv("Timecode,a\nnan,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n1e300,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n-1,0\n"), "line 2: the time '-1' is below 0");
  expectError(csv("Timecode,a\n1:2:3,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n1:2:3:-4,0\n"), "not a timecode");
  for (const char* wrong : {"-00:00:01:00", "nan:0:0:0", "0:0:-nan:0"})
    expectError(csv(std::string("Timecode,a\n") + wrong + ",0\n"), "not a timecode");
  expectError(csv("Timecode,a\n10.5,0\n00:00:11:30,0\n"),
              "line 3: the time '00:00:11:30' is of another kind than the ones above");
  expectError(csv("Timecode,a\n12:59:60:1,0\n"), "more than 59 minutes or seconds");
  expectError(csv("Timecode,a\n12:60:59:1,0\n"), "more than 59 minutes or seconds");
  expectError(csv("Timecode,a\n0:0:0:60,0\n"),
              "more than 60 frames a second; give the recording's own rate");
  EXPECT_FALSE(parseLiveLinkCsv("Timecode,a\n1,2\n", "x", -1));
}

TEST(ClipJson, ReadsAudio2Face) {
  const auto clip = json(
      R"({"exportFps": 50, "facsNames": ["jawOpen", "smile"], "weightMat": [[0, 0.5], [1, 0.25]]})");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"jawOpen", "smile"}));
  EXPECT_EQ(clip->times, (std::vector<double>{0, 0.02}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 0.5, 1, 0.25}));
  EXPECT_TRUE(clip->warnings.empty());
  const auto cut =
      json(R"({"exportFps": 50, "numFrames": 3, "facsNames": ["a"], "weightMat": [[0]]})");
  ASSERT_EQ(cut->warnings.size(), 1u);
  EXPECT_NE(cut->warnings[0].find("'numFrames' is 3, but 'weightMat' has 1 frames"),
            std::string::npos);
}

TEST(ClipJson, ReadsMediaPipe) {
  const std::string frames = R"([
    {"timestampMs": 0, "faceBlendshapes": [{"categories": [
      {"categoryName": "_neutral", "score": 0.9}, {"categoryName": "jawOpen", "score": 0.5}]}]},
    {"timestampMs": 40, "faceBlendshapes": []},
    {"timestampMs": 80, "categories": [{"categoryName": "smile", "score": 1}]}])";
  for (const std::string& text : {frames, "{\"frames\": " + frames + "}"}) {
    const auto clip = json(text);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, (std::vector<std::string>{"jawOpen", "smile"}));
    EXPECT_EQ(clip->times, (std::vector<double>{0, 0.08}));
    EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 0, 0, 1}));
  }
}

TEST(ClipJson, FramesWithoutAFaceAreAsThoseAroundThem) {
  const auto frame = [](int time, const char* faces) {
    return "{\"timestampMs\": " + std::to_string(time) + ", \"faceBlendshapes\": [" + faces + "]}";
  };
  const char* open = R"({"categories": [{"categoryName": "jawOpen", "score": 0.5}]})";
  const char* shut = R"({"categories": [{"categoryName": "jawOpen", "score": 0.25}]})";
  const auto clip = json("[" + frame(0, "") + "," + frame(10, "") + "," + frame(20, open) + "," +
                         frame(30, "") + "," + frame(40, shut) + "," + frame(50, "") + "]");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->times, (std::vector<double>{0, 0.02, 0.04, 0.05}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 0.5, 0.25, 0.25}));
  EXPECT_EQ(clip->warnings, std::vector<std::string>{
                                "take.json: 4 of 6 frames found no face; weights go on from the "
                                "frames around them."});
}

TEST(ClipJson, ReadsMediaPipeFromPython) {
  constexpr std::string_view text = R"([
    {"face_blendshapes": [[{"index": 0, "category_name": "jawOpen", "score": 0.5}]]},
    {"face_blendshapes": []},
    {"face_blendshapes": [[{"index": 0, "category_name": "jawOpen", "score": 1}]]}])";
  const auto clip = parseClipJson(text, "take.json", 25);
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->times, (std::vector<double>{0, 0.08}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 1}));
  expectError(json(text),
              "has no 'timestampMs' in frame 0; add the milliseconds, or give the frames");
  EXPECT_FALSE(parseClipJson(text, "take.json", -1));
}

TEST(ClipJson, FramesAreNotCountedBeyondAllTimes) {
  const std::string frame = R"({"categories": [{"categoryName": "a", "score": 1}]})";
  const auto read = [&](double rate) {
    return parseClipJson("[" + frame + "," + frame + "]", "a.json", rate);
  };
  EXPECT_TRUE(read(0.1));
  for (const double rate : {1e-300, 1e-308}) expectError(read(rate), "not within 300 years");
}

TEST(ClipJson, WarnsOfTimesThatAreNoMilliseconds) {
  for (const char* step : {"0.033", "33000"}) {
    const auto clip =
        json(std::string(R"([{"timestamp": 0, "categories": [{"categoryName": "a", "score": 1}]},
      {"timestamp": )") +
             step + R"(, "categories": [{"categoryName": "a", "score": 0}]}])");
    ASSERT_TRUE(clip) << clip.error().message;
    ASSERT_EQ(clip->warnings.size(), 1u) << step;
    EXPECT_NE(clip->warnings[0].find("ms apart; are the times milliseconds"), std::string::npos);
  }
}

TEST(ClipJson, HoldsNoMoreWeightsThanAClipMay) {
  std::string text = "[";
  for (int f = 0; f < 9000; ++f)
    text += std::string(f > 0 ? "," : "") + R"({"timestampMs": )" + std::to_string(f) +
            R"(, "categories": [{"categoryName": "n)" + std::to_string(f) + R"(", "score": 1}]})";
  expectError(json(text + "]"), "take.json has 9000 names in 9000 frames, more than a clip");
}

TEST(ClipJson, SaysWhatIsWrong) {
  expectError(json(""), "this is not JSON");
  expectError(json("{"), "this is not JSON");
  expectError(json("{\"weightMat\": [[0.5, NaN]]}"),
              "line 1: this is not JSON, at column 22: 'NaN]]}'.");
  expectError(json("{}"), "neither of Audio2Face");
  expectError(json("[]"), "no frames");
  expectError(json("[1]"), "no 'timestampMs' in frame 0");
  expectError(json(R"([{"timestampMs": 0}])"), "no 'categories' in frame 0");
  expectError(json(R"([{"timestampMs": 0, "categories": [{"score": 1}]}])"), "categoryName");
  expectError(json(R"([{"timestampMs": 0, "categories": [{"categoryName": "a", "score": 1e9}]}])"),
              "a score in frame 0 that is not within ±1,000,000");
  expectError(
      json(R"([{"timestampMs": 5, "categories": []}, {"timestampMs": 5, "categories": []}])"),
      "frame 1 that is not after the one before");
  expectError(json(R"({"weightMat": []})"), "exportFps");
  expectError(json(R"({"weightMat": [], "exportFps": 60})"), "facsNames");
  expectError(json(R"({"weightMat": [], "exportFps": 60, "facsNames": ["a"]})"), "no frames");
  expectError(json(R"({"weightMat": [[1, 2]], "exportFps": 60, "facsNames": ["a"]})"),
              "has not 1 numbers in weightMat[0]");
  expectError(json(R"({"weightMat": [[null]], "exportFps": 60, "facsNames": ["a"]})"),
              "within ±1,000,000 in weightMat[0]");
  expectError(json(R"({"weightMat": [[1, 2]], "exportFps": 60, "facsNames": ["a", "a"]})"),
              "names 'a' twice in 'facsNames'");
  expectError(json(R"({"weightMat": [[1], [2]], "exportFps": 1e-320, "facsNames": ["a"]})"),
              "too low an 'exportFps'");
  expectError(json(R"([{"timestampMs": 1e300, "categories": []}])"), "a time in frame 0");
  expectError(json(std::string(10'000, '[')), "nested too deeply");
}

}  // namespace
}  // namespace sweepface
