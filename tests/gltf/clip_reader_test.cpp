#include <cmath>

#include "sweepface/keys.hpp"
#include "sweepface/trajectory.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// The small face ("open", "wink") with an animation of its weights.
Glb moving(std::string_view interpolation, const std::vector<float>& times,
           const std::vector<float>& values) {
  Glb glb = smallFace();
  const std::size_t input =
      glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", times.size());
  const std::size_t output =
      glb.addAccessor(glb.addView(bytesOf(values)), 5126, "SCALAR", values.size());
  glb.add(
      "animations",
      {{"name", "take"},
       {"samplers",
        Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
       {"channels",
        Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
  return glb;
}

Result<Clip> clipOf(const Glb& glb, std::string_view animation = {}) {
  return parseGltfClip(glb.bytes(), "move.glb", {}, animation);
}

double weight(const Clip& clip, double seconds, std::size_t k) {
  std::vector<double> all(clip.names.size());
  clip.at(seconds, all);
  return all[k];
}

// As players do, so that other animations of the file stay in step.
TEST(GltfClip, HoldTheirFirstKeyFromTheBeginning) {
  const auto clip = clipOf(moving("LINEAR", {1, 2, 4}, {0, 0.5f, 1, 0.25f, 0, 0.75f}));
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names, (std::vector<std::string>{"open", "wink"}));
  EXPECT_EQ(clip->times, (std::vector<double>{0, 1, 2, 4}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 0.5, 0, 0.5, 1, 0.25, 0, 0.75}));
}

TEST(GltfClip, StraightLinesKeepTheirKeys) {
  const auto clip = clipOf(moving("LINEAR", {0, 2, 4}, {0, 0.5f, 1, 0.25f, 0, 0.75f}));
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->times, (std::vector<double>{0, 2, 4}));
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 0.5, 1, 0.25, 0, 0.75}));
}

TEST(GltfClip, OfWeightsThatNoReaderTakesAreRefused) {
  const auto clip = clipOf(moving("LINEAR", {0, 1, 2}, {0, 0.5f, 1, 1e30f, 0, 0.75f}));
  ASSERT_FALSE(clip);
  EXPECT_NE(clip.error().message.find("±1,000,000"), std::string::npos) << clip.error().message;
}

TEST(GltfClip, CurvesAreFollowed) {
  const auto clip =
      clipOf(moving("CUBICSPLINE", {0, 2}, {0, 0, 0, 1, 0.5f, 0, /**/ 1, 0, 1, 1, 0, 0}));
  ASSERT_TRUE(clip) << clip.error().message;
  for (double t = 0; t <= 2; t += 0.01) {
    EXPECT_NEAR(weight(*clip, t, 0),
                0.25 * t * t * (3 - t) + (0.5 * t * (1 - t / 2) * (1 - t / 2)) +
                    (t * t / 4) * (t / 2 - 1) * 2,
                2e-4);
    EXPECT_NEAR(weight(*clip, t, 1), 1, 1e-6);
  }
}

TEST(GltfClip, StepsHold) {
  const auto clip = clipOf(moving("STEP", {0, 1, 2}, {0, 0, 1, 0, 0, 0}));
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(weight(*clip, 0.99, 0), 0);
  EXPECT_EQ(weight(*clip, 1, 0), 1);
  EXPECT_EQ(weight(*clip, 1.99, 0), 1);
  EXPECT_EQ(weight(*clip, 2, 0), 0);
}

TEST(GltfClip, LongStepsHoldAsWell) {
  const auto clip = clipOf(moving("STEP", {0, 100, 101}, {0, 0, 1, 0, 0, 0}));
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(weight(*clip, 99.999, 0), 0);
  EXPECT_EQ(weight(*clip, 100, 0), 1);
}

TEST(GltfClip, LateStepsCanBeWritten) {
  const Glb glb = moving("STEP", {0, 3000, 4000}, {0, 0, 1, 0, 0, 0});
  const Clip clip = clipOf(glb).value();
  const auto bytes = formatGlb(converted(glb), {.clip = &clip, .animationName = "again"});
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto again = parseGltfClip(*bytes, "again.glb", {}, "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(weight(*again, 2999.99, 0), 0);
  EXPECT_EQ(weight(*again, 3000, 0), 1);
  EXPECT_EQ(weight(*again, 3999.99, 0), 1);
}

TEST(GltfClip, StepsBeforeZeroHoldAsWell) {
  const auto clip = clipOf(moving("STEP", {-4000, -3000}, {0, 0, 1, 0}));
  ASSERT_TRUE(clip) << clip.error().message;
  ASSERT_EQ(clip->times.size(), 3u);
  EXPECT_LT(clip->times[1], -3000);
}

TEST(GltfClip, OfSeveralMeshesTheFirstOneCounts) {
  Glb glb = moving("LINEAR", {0, 1}, {0, 0, 1, 0.5f});
  Json other = glb.json["meshes"][0];
  glb.add("meshes", other);
  other["extras"]["targetNames"] = {"wink", "smile"};
  glb.add("meshes", other);
  Json& channels = glb.json["animations"][0]["channels"];
  for (const int mesh : {1, 2}) {
    channels.push_back(channels[0]);
    channels.back()["target"]["node"] = glb.add("nodes", {{"mesh", mesh}});
  }
  // The second mesh has the same targets; even its keys are ignored.
  Json& samplers = glb.json["animations"][0]["samplers"];
  samplers.push_back(samplers[0]);
  samplers[1]["input"] =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0, 0.5})), 5126, "SCALAR", 2);
  channels[1]["sampler"] = 1;
  for (int order = 0; order < 2; ++order) {  // the order of channels does not matter
    const auto clip = clipOf(glb);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, (std::vector<std::string>{"open", "wink", "smile"}));
    EXPECT_EQ(clip->times, (std::vector<double>{0, 1}));
    EXPECT_EQ(clip->weights, (std::vector<double>{0, 0, 0, 1, 0.5, 0.5}));
    std::ranges::reverse(channels);
  }
}

TEST(GltfClip, OfSeveralNodesThatShowAMeshTheFirstOneCounts) {
  Glb glb = moving("LINEAR", {0, 1}, {0, 0, 1, 0.5f});
  Json& animation = glb.json["animations"][0];
  Json other = animation["samplers"][0], channel = animation["channels"][0];
  other["output"] =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{1, 1, 1, 1})), 5126, "SCALAR", 4);
  animation["samplers"].push_back(other);
  channel["sampler"] = 1;
  channel["target"]["node"] = glb.add("nodes", {{"mesh", 0}});
  animation["channels"].insert(animation["channels"].begin(), channel);
  const auto clip = clipOf(glb);
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->weights, (std::vector<double>{0, 0, 1, 0.5}));
}

TEST(GltfClip, IsToldByPointersAsWell) {
  const Glb plain = moving("LINEAR", {0, 1}, {0, 0, 1, 0.5f});
  for (const char* pointer : {"/nodes/0/weights", "/meshes/0/weights"}) {
    Glb glb = plain;
    glb.json["animations"][0]["channels"][0]["target"] = {
        {"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    const auto clip = clipOf(glb);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->weights, clipOf(plain)->weights);
  }
}

TEST(GltfClip, WhatIsWrittenIsReadAgain) {
  const Rig rig = converted(withTargets(plane(4, 4), 2));
  const auto spring = Trajectory::spring({}, 1, {2, 0.3});
  Clip clip{{rig.targets[0].name, rig.targets[1].name}, {}, {}};
  for (int f = 0; f <= 720; ++f) {
    clip.times.push_back(f / 240.0);
    clip.weights.push_back(spring->at(f / 240.0).position);
    clip.weights.push_back(f < 360 ? 0 : 0.5);
  }
  const auto bytes = formatGlb(rig, {.clip = &clip, .keyTolerance = 1e-3, .animationName = "s"});
  ASSERT_TRUE(bytes);
  const auto again = parseGltfClip(*bytes, "move.glb", {}, "s");
  ASSERT_TRUE(again) << again.error().message;
  for (double t = 0; t <= 3; t += 1 / 240.0)
    for (const std::size_t k : {0, 1}) EXPECT_NEAR(weight(*again, t, k), weight(clip, t, k), 2e-3);
  const Written glb(*bytes);
  const Json& sampler = glb.json["animations"][0]["samplers"][0];
  EXPECT_EQ(sampler["interpolation"], "CUBICSPLINE");
  EXPECT_LT(glb.accessor(sampler["input"])["count"], 40);
}

/// A triangle with many targets that do nothing, and two keys.
Glb manyTargets(std::size_t targets, std::string_view interpolation, float seconds) {
  Glb glb;
  const std::size_t position = glb.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  glb.add("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", position}}}}})}});
  for (std::size_t k = 0; k < targets; ++k) glb.primitive()["targets"].push_back(Json::object());
  glb.add("nodes", {{"mesh", 0}});
  const std::size_t input =
      glb.addAccessor(glb.addView(bytesOf(std::vector<float>{0, seconds})), 5126, "SCALAR", 2);
  const std::size_t keys = interpolation == "CUBICSPLINE" ? 6 : 2;
  const std::size_t output = glb.add(
      "accessors", {{"componentType", 5126}, {"type", "SCALAR"}, {"count", keys * targets}});
  glb.add(
      "animations",
      {{"samplers",
        Json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
       {"channels",
        Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}});
  return glb;
}

/// Adds copies of the first mesh, each with a target of its own that a channel moves the same way.
void addMeshes(Glb& glb, int count) {
  for (int k = 0; k < count; ++k) {
    Json mesh = glb.json["meshes"][0], channel = glb.json["animations"][0]["channels"][0];
    mesh["extras"]["targetNames"] = {std::to_string(k)};
    channel["target"]["node"] = glb.add("nodes", {{"mesh", glb.add("meshes", mesh)}});
    glb.json["animations"][0]["channels"].push_back(channel);
  }
}

TEST(GltfClip, HoldsNoMoreWeightsThanAClipMay) {
  EXPECT_EQ(clipOf(manyTargets(300, "CUBICSPLINE", 8)).value().weights.size(), 300u * 961);
  EXPECT_TRUE(failsWith(clipOf(manyTargets(300, "CUBICSPLINE", 8000)),
                        {"move.glb: its animation of 300 targets needs more than the 223696 "
                         "frames that a clip of them can hold"}));
}

/// Only curves are subdivided.
TEST(GltfClip, HoldsStraightLinesOfAnyLength) {
  for (const char* interpolation : {"LINEAR", "STEP"})
    EXPECT_TRUE(clipOf(manyTargets(300, interpolation, 1e6f))) << interpolation;
}

TEST(GltfClip, HoldsWhatManyChannelsMoveOnce) {
  Glb glb = manyTargets(2000, "CUBICSPLINE", 1);
  for (int k = 0; k < 6000; ++k)
    glb.json["animations"][0]["channels"].push_back(glb.json["animations"][0]["channels"][0]);
  EXPECT_TRUE(clipOf(glb));
}

TEST(GltfClip, HoldsNoMoreValuesThanAClipMay) {
  constexpr std::size_t keys = 10'000, targets = 50;
  Glb glb = manyTargets(targets, "LINEAR", 1);
  std::vector<float> times;
  for (std::size_t k = 0; k < keys; ++k) times.push_back(static_cast<float>(k));
  Json& sampler = glb.json["animations"][0]["samplers"][0];
  sampler["input"] = glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", keys);
  sampler["output"] = glb.add(
      "accessors", {{"componentType", 5126}, {"type", "SCALAR"}, {"count", keys * targets}});
  addMeshes(glb, 150);
  EXPECT_TRUE(
      failsWith(clipOf(glb), {"channels of its animation have more values than a clip can hold"}));
}

TEST(GltfClip, CountsFramesThatTracksHaveInCommonOnce) {
  constexpr int meshes = 100, seconds = 60;
  Glb glb = manyTargets(1, "CUBICSPLINE", seconds);
  addMeshes(glb, meshes - 1);
  const auto clip = clipOf(glb);
  ASSERT_TRUE(clip) << clip.error().message;
  EXPECT_EQ(clip->names.size(), std::size_t{meshes});
  EXPECT_EQ(clip->times.size(), std::size_t{120 * seconds + 1});
  EXPECT_GT(meshes * clip->weights.size(), kMostClipWeights);
}

// Frames that are slightly too many are not sorted again at every key.
TEST(GltfClip, RefusesTooManyDifferentFramesSoon) {
  constexpr int meshes = 100;
  constexpr std::size_t keys = 10'001;
  Glb glb = manyTargets(1, "CUBICSPLINE", 1);
  std::vector<float> times;  // nearly twice the frames that a clip of so many targets can hold
  for (std::size_t k = 0; k < keys; ++k) times.push_back(static_cast<float>(k) * 134.f / 120);
  Json& sampler = glb.json["animations"][0]["samplers"][0];
  sampler["input"] = glb.addAccessor(glb.addView(bytesOf(times)), 5126, "SCALAR", keys);
  sampler["output"] =
      glb.add("accessors", {{"componentType", 5126}, {"type", "SCALAR"}, {"count", 3 * keys}});
  addMeshes(glb, meshes - 1);
  EXPECT_TRUE(failsWith(clipOf(glb), {"needs more than the 671088 frames"}));
}

TEST(GltfClip, SparseTimesMayNotClaimMoreThanTheFileCanMean) {
  Glb glb = moving("LINEAR", {0, 1}, {0, 0, 1, 1});
  for (const char* part : {"input", "output"}) {
    Glb changed = glb;
    const std::size_t claim = changed.addSparse(std::size_t{1} << 40, {1}, {{1, 2, 3}});
    changed.json["animations"][0]["samplers"][0][part] = claim;
    EXPECT_TRUE(failsWith(clipOf(changed), {"move.glb: accessor", "elements without data"}));
  }
}

TEST(GltfClip, SaysWhatIsWrong) {
  const auto fails = [](const Glb& glb, std::string_view why, std::string_view animation = {}) {
    return failsWith(clipOf(glb, animation), {"move.glb", why});
  };
  EXPECT_TRUE(fails(smallFace(), "no animation of morph targets"));
  EXPECT_TRUE(fails(moving("LINEAR", {0, 1}, {0, 0, 1, 1}), "named 'walk'", "walk"));
  EXPECT_TRUE(fails(moving("LINEAR", {1, 1}, {0, 0, 1, 1}), "do not increase"));
  EXPECT_TRUE(fails(moving("LINEAR", {0, 1e20f}, {0, 0, 1, 1}), "within 300 years"));
  EXPECT_TRUE(fails(moving("LINEAR", {-1e20f, 1}, {0, 0, 1, 1}), "within 300 years"));
  EXPECT_TRUE(fails(moving("LINEAR", {0, 1}, {0, 0, 1}), "3 values for 2 keys of 2 targets"));
  EXPECT_TRUE(fails(moving("CUBICSPLINE", {0, 1}, {0, 0, 1, 1}), "4 values"));
  EXPECT_TRUE(fails(moving("SPLINE", {0, 1}, {0, 0, 1, 1}), "interpolation"));
  Glb glb = moving("LINEAR", {0, 1}, {0, 0, 1, 1});
  glb.json["animations"][0]["name"] = "talk";
  Json nod = glb.json["animations"][0];
  nod["name"] = "nod", nod["channels"][0]["target"]["path"] = "rotation";
  glb.json["animations"].push_back(nod);
  EXPECT_TRUE(fails(glb, "named 'nod'; those that it has are 'talk'.", "nod"));
  EXPECT_EQ(clipOf(glb)->title, "talk");
  EXPECT_TRUE(clipOf(glb, "talk")->warnings.empty());
  Glb both = glb;  // a nod may have the same name
  both.json["animations"][1]["name"] = "talk";
  EXPECT_TRUE(clipOf(both, "talk")->warnings.empty());
  Glb twice = glb;
  twice.json["animations"].push_back(glb.json["animations"][0]);
  ASSERT_EQ(clipOf(twice, "talk")->warnings.size(), 1u);
  EXPECT_TRUE(
      clipOf(twice, "talk")->warnings[0].starts_with("Several of its animations are named 'talk'"));
  // Up to ten names are listed, wherever their animations are.
  Glb many = glb;
  many.json["animations"] = Json::array();
  for (int k = 0; k < 12; ++k) many.json["animations"].push_back(nod);
  many.json["animations"].push_back(glb.json["animations"][0]);
  EXPECT_TRUE(fails(many, "are 'talk'.", "nod"));
  for (Json& animation : many.json["animations"]) animation = glb.json["animations"][0];
  EXPECT_TRUE(fails(many,
                    "are 'talk', 'talk', 'talk', 'talk', 'talk', 'talk', 'talk', 'talk', 'talk', "
                    "'talk', ....",
                    "nod"));
  glb.json["animations"][0]["samplers"][0]["input"] = 99;
  EXPECT_TRUE(fails(glb, "'input' is 99"));
  EXPECT_TRUE(failsWith(parseGltfClip("glTF", "move.glb", {}), {"move.glb"}));
}

}  // namespace
}  // namespace sweepface
