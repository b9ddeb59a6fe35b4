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

TEST(LiveLinkCsv, GoesOnPastMidnight) {
  const auto clip = csv("Timecode,a\n23:59:59:30,0\n0:0:0:0,1\n0:0:0:30,2\n");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->seconds(), 1);
  expectError(csv("Timecode,a\n10:0:0:0,0\n9:59:59:0,1\n"), "is not after");
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
  expectError(csv("Timecode,a\n1,nan\n"), "'nan' in column 2 is not a number");
  expectError(csv("Timecode,a\n1,1e7\n"), "'1e7' in column 2 is not a number within ±1,000,000");
  expectError(csv("Timecode,a\n1,x\n"), "'x' in column 2");
  expectError(csv("Timecode,a\n1,\n"), "'' in column 2");
  expectError(csv("Timecode,a\n2,0\n1,0\n"), "line 3: the timecode '1' is not after");
  expectError(csv("Timecode,a\n2,0\n2,0\n"), "is not after");
  expectError(csv("Timecode,a\nnan,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n1e300,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n-1,0\n"), "line 2: the time '-1' is below 0");
  expectError(csv("Timecode,a\n1:2:3,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n1:2:3:-4,0\n"), "not a timecode");
  expectError(csv("Timecode,a\n12:59:60:1,0\n"), "more than 59 minutes or seconds");
  expectError(csv("Timecode,a\n12:60:59:1,0\n"), "more than 59 minutes or seconds");
  expectError(csv("Timecode,a\n0:0:0:60,0\n"), "more than 60 frames a second");
  EXPECT_FALSE(parseLiveLinkCsv("Timecode,a\n1,2\n", "x", 0));
}

TEST(ClipJson, ReadsAudio2Face) {
  const auto clip = json(
      R"({"exportFps": 50, "facsNames": ["jawOpen", "smile"], "weightMat": [[0, 0.5], [1, 0.25]]})");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"jawOpen", "smile"}));
  EXPECT_EQ(clip->times, (std::vector<double>{0, 0.02}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 0.5, 1, 0.25}));
}

TEST(ClipJson, ReadsMediaPipe) {
  const auto clip = json(R"([
    {"timestampMs": 0, "faceBlendshapes": [{"categories": [
      {"categoryName": "_neutral", "score": 0.9}, {"categoryName": "jawOpen", "score": 0.5}]}]},
    {"timestampMs": 40, "faceBlendshapes": []},
    {"timestampMs": 80, "categories": [{"categoryName": "smile", "score": 1}]}])");
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"jawOpen", "smile"}));
  EXPECT_EQ(clip->times, (std::vector<double>{0, 0.04, 0.08}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0.5, 0, 0, 0, 0, 1}));
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
  expectError(json("{}"), "neither of Audio2Face");
  expectError(json("[]"), "no frames");
  expectError(json("[1]"), "no 'timestampMs' in frame 0");
  expectError(json(R"([{"timestampMs": 0}])"), "no 'categories' in frame 0");
  expectError(json(R"([{"timestampMs": 0, "categories": [{"score": 1}]}])"), "categoryName");
  expectError(
      json(R"([{"timestampMs": 5, "categories": []}, {"timestampMs": 5, "categories": []}])"),
      "frame 1 that is not after");
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
