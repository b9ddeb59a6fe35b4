#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sweepface/clip.hpp"
#include "sweepface/filter.hpp"
#include "sweepface/head.hpp"
#include "sweepface/sweepface_clips.h"
#include "sweepface/timeline.hpp"

#include "capi/refuses.hpp"
#include "codec/rigs.hpp"
#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace testing;

constexpr std::string_view kCsv =
    "Timecode,BlendshapeCount,Open,Rest,TongueOut,HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw\n"
    "00:00:00:00.0,52,0,1,0.5,0.1,0.2,0.3,0.4\n"
    "00:00:00:30.0,52,1,0.5,0.5,0.3,0.2,0.1,0\n"
    "00:00:01:00.0,52,0.2,0,0.5,0,0,0,0\n";
constexpr std::string_view kTimeline = R"({
  "seconds": 2,
  "events": [{"at": 0, "to": {"open": 1}, "drive": "accelerate-brake", "seconds": 1},
             {"at": 0.5, "to": {"rest": 1}, "region": "part"}],
  "regions": [{"name": "part", "nodes": {"0": 1, "2": 0.25}, "mass": 4, "stiffness": 2,
               "delay": 0.25}]
})";

/// A face with the targets "open", "wink é" and "rest".
class Clips : public ::testing::Test {
 protected:
  Clips() : rig(dressed(makeRig(tee()))) {
    const std::string bytes = encode(rig);
    EXPECT_EQ(sweepface_rig_load(bytes.data(), bytes.size(), "tee", &handle), SWEEPFACE_OK);
  }
  ~Clips() override {
    sweepface_clip_free(clip);
    sweepface_rig_free(handle);
  }

  sweepface_status read(std::string_view text, const sweepface_clip_options* options = nullptr) {
    sweepface_clip_free(std::exchange(clip, nullptr));
    return sweepface_clip_read(handle, text.data(), text.size(), "take", options, &clip);
  }
  std::vector<double> at(double seconds, std::size_t count = 3) {
    std::vector<double> weights(count);
    EXPECT_EQ(sweepface_clip_weights(clip, seconds, weights.data(), count), SWEEPFACE_OK);
    return weights;
  }
  ::testing::AssertionResult refusesToRead(std::string_view text, std::string_view part) {
    const sweepface_status status = read(text);
    EXPECT_EQ(clip, nullptr);
    return refuses(status, part, SWEEPFACE_BAD_DATA);
  }

  Rig rig;
  sweepface_rig* handle = nullptr;
  sweepface_clip* clip = nullptr;
};

TEST_F(Clips, GiveTheWeightsOfATime) {
  ASSERT_EQ(read(kCsv), SWEEPFACE_OK) << sweepface_message();
  EXPECT_EQ(sweepface_clip_seconds(clip), 1);
  EXPECT_EQ(at(-1), (std::vector{0.0, 0.0, 1.0}));
  EXPECT_EQ(at(0.25), (std::vector{0.5, 0.0, 0.75}));
  EXPECT_EQ(at(9), (std::vector{0.2, 0.0, 0.0}));
  EXPECT_EQ(at(0.5, 1), (std::vector{1.0}));
}

TEST_F(Clips, TellWhatMatchesNothing) {
  ASSERT_EQ(read(kCsv), SWEEPFACE_OK);
  EXPECT_STREQ(sweepface_clip_unmatched(clip, 0), "TongueOut");
  EXPECT_EQ(sweepface_clip_unmatched(clip, 1), nullptr);
  EXPECT_STREQ(sweepface_clip_undriven(clip, 0), "wink \xC3\xA9");
  EXPECT_EQ(sweepface_clip_undriven(clip, 1), nullptr);
}

TEST_F(Clips, DriveWhatATextOfNamesSays) {
  sweepface_clip_options options = sweepface_clip_usual_options();
  options.names = R"({"TongueOut": {"open": 0.5}})";
  ASSERT_EQ(read("Timecode,TongueOut\n0,0.4\n1,0.4\n", &options), SWEEPFACE_OK)
      << sweepface_message();
  EXPECT_EQ(at(0)[0], 0.2);
  options.names = R"({"TongueOut": "opn"})";
  EXPECT_EQ(read(kCsv, &options), SWEEPFACE_BAD_DATA);
  EXPECT_STREQ(sweepface_message(),
               "The text of names: 'TongueOut' drives 'opn', which is no target of the face.");
}

TEST_F(Clips, WarnOfNamesForOneTargetAndOfWhatFramesMiss) {
  ASSERT_EQ(read("Timecode,Open,o_pen\n0,0.3,0.7\n1,0.3,0.7\n"), SWEEPFACE_OK)
      << sweepface_message();
  EXPECT_EQ(at(0.5)[0], 0.7);
  EXPECT_STREQ(sweepface_clip_warning(clip, 0),
               "take: Open and o_pen drive the target open, whichever is largest.");
  EXPECT_EQ(sweepface_clip_warning(clip, 1), nullptr);
  ASSERT_EQ(read(R"({"seconds": 1, "events": [{"at": 0, "to": {"open": 1}, "drive": "spring",
                     "frequency": 20000, "damping": 0}]})"),
            SWEEPFACE_OK);
  const std::string_view warned = sweepface_clip_warning(clip, 0);
  EXPECT_EQ(warned.find("take: it moves more quickly, or for longer, than frames can tell"), 0u);
}

TEST_F(Clips, AreOfManyKinds) {
  ASSERT_EQ(read(R"({"exportFps": 2, "facsNames": ["open"], "weightMat": [[0], [1]]})"),
            SWEEPFACE_OK);
  EXPECT_EQ(at(0.25)[0], 0.5);
  ASSERT_EQ(read(R"( [{"timestampMs": 0, "categories": [{"categoryName": "Open", "score": 0.5}]},
                      {"timestampMs": 250, "categories": []},
                      {"timestampMs": 500, "categories": [{"categoryName": "Open", "score": 0}]}])"),
            SWEEPFACE_OK);
  EXPECT_EQ(at(0.25)[0], 0.25);
  EXPECT_STREQ(sweepface_clip_warning(clip, 0),
               "take: 1 of 3 frames found no face; weights go on from the frames around them.");
  EXPECT_EQ(sweepface_clip_warning(clip, 1), nullptr);
  EXPECT_TRUE(refusesToRead("glTF\x02", "take"));
}

TEST_F(Clips, OfNumberedFramesGoAtTheRateOfTheirOptions) {
  sweepface_clip_options options = sweepface_clip_usual_options();
  options.frames_per_second = 20;
  for (const std::string_view text :
       {R"([{"categories": [{"categoryName": "open", "score": 0}]}, {"categories": []},
            {"categories": [{"categoryName": "open", "score": 1}]}])",
        "Timecode,open\n0:0:0:0,0\n0:0:0:2,1\n"}) {
    ASSERT_EQ(read(text, &options), SWEEPFACE_OK) << sweepface_message();
    EXPECT_EQ(sweepface_clip_seconds(clip), 0.1);
  }
}

TEST_F(Clips, AreToldApartBehindAByteOrderMark) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  const std::string capture =
      R"({"events": 0, "exportFps": 2, "facsNames": ["open"], "weightMat": [[0], [1]]})";
  ASSERT_EQ(read(std::string(mark) + std::string(kCsv)), SWEEPFACE_OK) << sweepface_message();
  ASSERT_EQ(read(std::string(mark) + " " + capture.substr(0, 1) + capture.substr(14)), SWEEPFACE_OK)
      << sweepface_message();
  EXPECT_EQ(at(0.25)[0], 0.5);
  EXPECT_TRUE(refusesToRead(std::string(mark) + capture, "unknown key"));
}

TEST_F(Clips, ThatSpeakOfEventsAreNoTimelines) {
  ASSERT_EQ(read(R"({"exportFps": 2, "facsNames": ["open", "events"],
                     "weightMat": [[0, 0], [1, 0]], "more": {"events": []}})"),
            SWEEPFACE_OK)
      << sweepface_message();
  EXPECT_EQ(at(0.25)[0], 0.5);
}

TEST_F(Clips, OfAllRegionsHoldNoMoreThanOneMay) {
  std::string regions = R"({"regions": [)", goals = R"("open": 1)";
  for (int r = 0; r < 8; ++r)
    regions += std::string(r > 0 ? "," : "") + R"({"name": "r)" + std::to_string(r) +
               R"(", "nodes": {"0": 0.1, "2": 0.1}})";
  regions += "]}";
  ASSERT_EQ(sweepface_rig_divide_by(handle, regions.data(), regions.size(), "scene"), SWEEPFACE_OK)
      << sweepface_message();
  for (int k = 0; k < 39; ++k) goals += ",\"n" + std::to_string(k) + "\": 1";
  EXPECT_TRUE(refusesToRead(R"({"seconds": 1000, "events": [{"at": 0, "to": {)" + goals + R"(}}]})",
                            "take: it is too long for 9 regions"));
}

TEST_F(Clips, LoseTheirNoise) {
  sweepface_clip_options options = sweepface_clip_usual_options();
  options.smooth = 1;
  ASSERT_EQ(read(kCsv, &options), SWEEPFACE_OK);
  Clip same = *parseLiveLinkCsv(kCsv, "take");
  smooth(same);
  EXPECT_EQ(at(0.5)[0], same.weights[same.names.size()]);
  const sweepface_clip_options nothing{60, 0, 0, 1, nullptr, nullptr};
  EXPECT_EQ(read(kCsv, &nothing), SWEEPFACE_BAD_ARGUMENT);
}

TEST_F(Clips, OfAGlbAreChosenByTheirNames) {
  Glb glb = smallFace();
  const std::size_t times =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0, 1})), 5126, "SCALAR", 2);
  for (const auto& [name, open] : {std::pair{"idle", 0.25f}, {"talk", 0.75f}}) {
    const std::vector<float> weights{open, 0, open, 0};
    const std::size_t output = glb.addAccessor(glb.addView(bytesOf(weights)), 5126, "SCALAR", 4);
    glb.add("animations",
            {{"name", name},
             {"samplers", Json::array({{{"input", times}, {"output", output}}})},
             {"channels",
              Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
  }
  sweepface_clip_options options = sweepface_clip_usual_options();
  for (const auto& [name, open] : {std::pair<const char*, double>{nullptr, 0.25}, {"talk", 0.75}}) {
    options.animation = name;
    ASSERT_EQ(read(glb.bytes(), &options), SWEEPFACE_OK) << sweepface_message();
    EXPECT_EQ(at(0.5)[0], open);
  }
  options.animation = "walk";
  EXPECT_EQ(read(glb.bytes(), &options), SWEEPFACE_BAD_DATA);
  EXPECT_STREQ(sweepface_message(),
               "take: it has no animation of morph targets named 'walk'; those that it has are "
               "'idle', 'talk'.");
}

TEST_F(Clips, OfTimelinesGoByTheirRegions) {
  EXPECT_TRUE(
      refusesToRead(kTimeline, "for a region 'part', but the face is not divided into regions."));
  std::string everywhere(kTimeline);
  everywhere.erase(everywhere.find(R"(, "region": "part")"), 18);
  ASSERT_EQ(read(everywhere), SWEEPFACE_OK) << sweepface_message();
  EXPECT_STREQ(sweepface_clip_warning(clip, 0),
               "take: its regions count only if the face is divided by them first.");
  ASSERT_EQ(sweepface_rig_divide_by(handle, kTimeline.data(), kTimeline.size(), "scene"),
            SWEEPFACE_OK)
      << sweepface_message();
  ASSERT_EQ(sweepface_rig_region_count(handle), 2U);
  EXPECT_STREQ(sweepface_rig_region_name(handle, 1), "part");
  sweepface_matter matter{};
  ASSERT_EQ(sweepface_rig_region_matter(handle, 1, &matter), SWEEPFACE_OK);
  EXPECT_EQ(matter.mass, 4);
  EXPECT_EQ(matter.stiffness, 2);
  EXPECT_EQ(matter.delay, 0.25);
  ASSERT_EQ(read(kTimeline), SWEEPFACE_OK) << sweepface_message();
  const auto timeline = *parseTimeline(kTimeline, "take");
  const Clip rest = *bake(timeline, 240, "rest", {}),
             part = *bake(timeline, 240, "part", {4, 2, 0.25});
  for (const double time : {0.1, 0.5, 1.3, 2.0}) {
    const std::vector<double> weights = at(time, 6);
    std::vector<double> a(2), b(2);
    rest.at(time, a), part.at(time, b);
    EXPECT_EQ(weights, (std::vector{a[0], 0.0, a[1], b[0], 0.0, b[1]}));
  }
  EXPECT_EQ(at(2, 6)[2], 0);
  EXPECT_GT(at(2, 6)[5], 0.5);
  ASSERT_EQ(sweepface_rig_divide_by(handle, "{}", 2, nullptr), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  EXPECT_EQ(sweepface_clip_region_count(clip), 2U) << "as it was read";
}

TEST_F(Clips, OfTimelinesTurnTheHeadWhateverTheFaceIsMadeOf) {
  constexpr std::string_view heavy = R"({
    "seconds": 2,
    "events": [{"at": 0, "to": {"open": 1, "HeadYaw": 0.5}, "drive": "newton", "seconds": 1}],
    "regions": [{"name": "all", "points": [[0, 0, 0]], "over": "space", "whole": 1e6, "fade": 1,
                 "mass": 4, "delay": 0.25}]
  })";
  ASSERT_EQ(sweepface_rig_divide_by(handle, heavy.data(), heavy.size(), "scene"), SWEEPFACE_OK)
      << sweepface_message();
  ASSERT_EQ(sweepface_rig_region_count(handle), 1U) << "there is no rest";
  ASSERT_EQ(read(heavy), SWEEPFACE_OK) << sweepface_message();
  EXPECT_LT(at(1)[0], 0.2);
  sweepface_pose pose{};
  ASSERT_EQ(sweepface_clip_pose(clip, 1, &pose), SWEEPFACE_OK);
  EXPECT_EQ(pose.head.yaw, -0.5);
}

TEST_F(Clips, HangOnTheUsualSpringWhereItsOptionsAreZeros) {
  ASSERT_EQ(sweepface_rig_divide_by(handle, kTimeline.data(), kTimeline.size(), "scene"),
            SWEEPFACE_OK);
  ASSERT_EQ(read(kCsv), SWEEPFACE_OK);
  EXPECT_GE(sweepface_clip_seconds(clip), 1.25) << "until the last region is there";
  const std::vector<double> usual = at(0.3, 6);
  sweepface_clip_options options{};
  ASSERT_EQ(read(kCsv, &options), SWEEPFACE_OK) << sweepface_message();
  EXPECT_EQ(at(0.3, 6), usual);
  for (const auto& [frequency, damping] : {std::pair(1, 1.0), {2, 0.2}}) {
    options.frequency = frequency, options.damping = damping;
    ASSERT_EQ(read(kCsv, &options), SWEEPFACE_OK);
    EXPECT_NE(at(0.3, 6), usual) << damping;
  }
}

TEST_F(Clips, HaveThePoseOfTheHead) {
  ASSERT_EQ(read(kCsv), SWEEPFACE_OK);
  EXPECT_TRUE(sweepface_clip_has_head(clip));
  EXPECT_TRUE(sweepface_clip_has_eyes(clip));
  sweepface_pose pose{};
  ASSERT_EQ(sweepface_clip_pose(clip, 0, &pose), SWEEPFACE_OK);
  EXPECT_EQ(pose.head.yaw, -0.1) << "captures are left-handed";
  EXPECT_EQ(pose.head.pitch, 0.2);
  EXPECT_EQ(pose.head.roll, -0.3);
  EXPECT_EQ(pose.left_eye.yaw, -0.4);
  EXPECT_EQ(pose.right_eye.yaw, 0);
  ASSERT_EQ(read("Timecode,Open,HeadYaw,LeftEyeYaw\n0,0,0,0\n1,1,0,0\n"), SWEEPFACE_OK);
  EXPECT_TRUE(sweepface_clip_has_head(clip));
  EXPECT_FALSE(sweepface_clip_has_eyes(clip));
  double found[4];
  sweepface_rotation(&pose.head, found);
  EXPECT_TRUE(std::ranges::equal(found, quaternionOf({-0.1, 0.2, -0.3})));
}

TEST_F(Clips, MayTurnNothingButTheHead) {
  ASSERT_EQ(read("Timecode,HeadYaw\n0,0.5\n1,0\n"), SWEEPFACE_OK) << sweepface_message();
  EXPECT_TRUE(sweepface_clip_has_head(clip));
  EXPECT_EQ(at(0.5), (std::vector{0.0, 0.0, 0.0}));
}

TEST_F(Clips, AreRefusedWithASentence) {
  EXPECT_TRUE(refusesToRead("", "take is empty"));
  EXPECT_TRUE(refusesToRead("Timecode,Open\n0,x\n", "take, line 2: 'x' in column 2"));
  EXPECT_TRUE(refusesToRead("{", "this is not JSON"));
  EXPECT_TRUE(refusesToRead("Timecode,Beard\n0,1\n", "none of its 1 names is a target"));
  EXPECT_TRUE(refusesToRead("Timecode,Beard,HeadYaw\n0,1,1\n", "none of its 2 names is a target"));
  for (const double rate : {-1.0, std::nan(""), HUGE_VAL}) {
    auto options = sweepface_clip_usual_options();
    options.frames_per_second = rate;
    EXPECT_EQ(read(kCsv, &options), SWEEPFACE_BAD_ARGUMENT);
  }
  double room[4];
  EXPECT_EQ(sweepface_clip_weights(nullptr, 0, room, 1), SWEEPFACE_BAD_ARGUMENT);
  ASSERT_EQ(read(kCsv), SWEEPFACE_OK);
  EXPECT_EQ(sweepface_clip_weights(clip, 0, room, 4), SWEEPFACE_BAD_ARGUMENT);
  EXPECT_EQ(sweepface_rig_divide_by(handle, "[", 1, nullptr), SWEEPFACE_BAD_DATA);
  for (const std::string_view none : {"5", "null", R"([{"name": "a"}])", R"({"region": []})"}) {
    EXPECT_EQ(sweepface_rig_divide_by(handle, none.data(), none.size(), "r.json"),
              SWEEPFACE_BAD_DATA);
    EXPECT_EQ(std::string_view(sweepface_message()).find("r.json has no 'regions'"), 0u) << none;
  }
  const std::string_view nowhere = R"({"regions": [{"name": "a", "parts": ["beard"]}]})";
  EXPECT_EQ(sweepface_rig_divide_by(handle, nowhere.data(), nowhere.size(), "r.json"),
            SWEEPFACE_BAD_ARGUMENT);
  EXPECT_NE(std::string_view(sweepface_message()).find("r.json: "), std::string_view::npos);
  EXPECT_EQ(sweepface_rig_region_count(handle), 1U);
  sweepface_matter matter{};
  EXPECT_EQ(sweepface_rig_region_matter(handle, 1, &matter), SWEEPFACE_BAD_ARGUMENT);
}

}  // namespace
}  // namespace sweepface
