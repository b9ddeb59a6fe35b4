#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sweepface/keys.hpp"

#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

Motion motionOf(const Rig& rig, TimeLaw law, double seconds = 1) {
  Weights from(rig.targets.size()), to(rig.targets.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    from[k] = 0.3 * static_cast<double>(k) - 0.2;
    to[k] = 1 - 0.7 * static_cast<double>(k);
  }
  return Motion::make(from, to, law, seconds).value();
}

const Json& lastAnimation(const Written& glb) { return glb.json["animations"].back(); }

class Laws : public ::testing::TestWithParam<TimeLaw> {};
INSTANTIATE_TEST_SUITE_P(AnimationWriter, Laws, ::testing::ValuesIn(timeLaws), [](const auto& law) {
  std::string name(nameOf(law.param));
  std::erase(name, '-');
  return name;
});

TEST_P(Laws, HoldAtAnyTime) {
  const Rig rig = converted(withTargets(plane(4, 4), 3));
  for (const double seconds : {0.3, 1.0, 1234.5678}) {
    const Motion motion = motionOf(rig, GetParam(), seconds);
    const Written glb = write(rig, {.motion = &motion});
    const Json& animation = lastAnimation(glb);
    EXPECT_EQ(animation["name"], nameOf(GetParam()));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    for (int round = 0; round < 200; ++round) {
      const double time = share(random) * seconds;
      Weights expected(3);
      motion.at(time, expected);
      const std::vector<double> found = evaluate(glb, animation, 0, time);
      ASSERT_EQ(found.size(), 3u);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 5e-7);
    }
  }
}

TEST_P(Laws, NeedTwoOrThreeKeys) {
  const Rig rig = converted(withTargets(plane(4, 4), 1));
  const Motion motion = motionOf(rig, GetParam());
  const Written glb = write(rig, {.motion = &motion});
  const Json& sampler = lastAnimation(glb)["samplers"][0];
  EXPECT_EQ(sampler["interpolation"], GetParam() == TimeLaw::linear ? "LINEAR" : "CUBICSPLINE");
  const Json& input = glb.accessor(sampler["input"]);
  EXPECT_EQ(input["count"], GetParam() == TimeLaw::accelerateBrake ? 3 : 2);
  EXPECT_EQ(input["min"], Json::array({0.0}));
  EXPECT_EQ(input["max"], Json::array({1.0}));
}

/// The motion as keys without tangents.
Clip sampled(const Rig& rig, const Motion& motion, int keys) {
  Clip clip;
  for (const Target& target : rig.targets) clip.names.push_back(target.name);
  Weights weights(motion.size());
  for (int key = 0; key < keys; ++key) {
    clip.times.push_back(motion.seconds() * key / (keys - 1));
    motion.at(clip.times.back(), weights);
    clip.weights.insert(clip.weights.end(), weights.begin(), weights.end());
  }
  return clip;
}

TEST_P(Laws, CanBeSampled) {
  const Rig rig = converted(withTargets(plane(4, 4), 2));
  const Motion motion = motionOf(rig, GetParam(), 0.7);
  const Clip clip = sampled(rig, motion, 8);
  const Written glb = write(rig, {.clip = &clip, .animationName = "eight"});
  EXPECT_EQ(lastAnimation(glb)["name"], "eight");
  const Json& sampler = lastAnimation(glb)["samplers"][0];
  EXPECT_EQ(sampler["interpolation"], "LINEAR");
  EXPECT_EQ(glb.accessor(sampler["input"])["count"], 8);
  for (int key = 0; key < 8; ++key) {
    const double time = 0.1 * key;
    Weights expected(2);
    motion.at(time, expected);
    const std::vector<double> found = evaluate(glb, lastAnimation(glb), 0, time);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6);
  }
}

/// A head with "open" and "wink" shown by two nodes, an eye with "open" alone, and a mesh without
/// targets.
Glb scene() {
  Glb glb = smallFace();
  Json eye = glb.json["meshes"][0], still = eye;
  eye["primitives"][0]["targets"].erase(1);
  eye["extras"]["targetNames"] = Json::array({"open"});
  still["primitives"][0].erase("targets");
  still.erase("extras");
  glb.json["meshes"].push_back(eye);
  glb.json["meshes"].push_back(still);
  for (const int mesh : {0, 1, 2}) glb.add("nodes", {{"mesh", mesh}});
  return glb;
}

TEST(AnimationWriter, MovesEveryNodeThatShowsTargets) {
  const Rig rig = converted(scene());
  const Motion motion = motionOf(rig, TimeLaw::brake);
  const Written glb = write(rig, {.motion = &motion});
  const Json& animation = lastAnimation(glb);
  ASSERT_EQ(animation["channels"].size(), 3u);
  Weights expected(2);
  motion.at(0.4, expected);
  const std::size_t open = rig.find("open"), wink = rig.find("wink");
  for (const Json& channel : animation["channels"]) {
    EXPECT_EQ(channel["target"]["path"], "weights");
    const std::size_t node = channel["target"]["node"], mesh = glb.json["nodes"][node]["mesh"];
    const std::vector<double> found = evaluate(glb, animation, channel["sampler"], 0.4);
    ASSERT_EQ(found.size(), mesh == 0 ? 2u : 1u);
    EXPECT_NEAR(found[0], expected[open], 1e-6);
    if (mesh == 0) {
      EXPECT_NEAR(found[1], expected[wink], 1e-6);
    }
  }
}

TEST(AnimationWriter, LeavesOtherAnimationsAsTheyAre) {
  Glb source = scene();
  const std::size_t input =
      source.addAccessor(source.addView(bytesOf(std::vector<float>{0, 2})), 5126, "SCALAR", 2);
  const std::size_t output = source.addAccessor(
      source.addView(bytesOf(std::vector<float>{0, 0, 1, 1})), 5126, "SCALAR", 4);
  const Json blink{
      {"name", "blink"},
      {"samplers", Json::array({{{"input", input}, {"output", output}}})},
      {"channels",
       Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}};
  source.add("animations", blink);
  const Rig rig = converted(source);
  const Motion motion = motionOf(rig, TimeLaw::newton);
  const Written glb = write(rig, {.motion = &motion});
  ASSERT_EQ(glb.json["animations"].size(), 2u);
  EXPECT_EQ(glb.json["animations"][0], blink);
  EXPECT_EQ(glb.json["animations"][1]["name"], "newton");
  for (const auto& [name, free] : {std::pair("blink", "blink 2"), std::pair("wink", "wink")})
    EXPECT_EQ(write(rig, {.motion = &motion, .animationName = name}).json["animations"][1]["name"],
              free);
}

TEST(AnimationWriter, RefusesWhatCannotMove) {
  const auto refuses = [](const Rig& rig, const Motion& motion, int keys, std::string_view why) {
    const Clip clip = sampled(rig, motion, std::max(keys, 2));
    const GlbOptions options = keys > 0 ? GlbOptions{.clip = &clip} : GlbOptions{.motion = &motion};
    EXPECT_TRUE(failsWith(formatGlb(rig, options), {why}));
  };
  const Rig still = converted(MeshRig{plane(4, 4), {}}),
            rig = converted(withTargets(plane(4, 4), 1));
  refuses(still, *Motion::make({}, {}, TimeLaw::newton, 1), 0, "no target");
  const auto motion = [](double from, double to, double seconds) {
    return *Motion::make(std::vector{from}, std::vector{to}, TimeLaw::newton, seconds);
  };
  refuses(rig, motion(0, 1, 1e-44), 0, "single precision");
  refuses(rig, motion(0, 1, 1e39), 0, "single precision");
  refuses(rig, motion(0, 1e39, 1), 0, "single precision");
  refuses(rig, motion(0, 1, 1e-44), 100, "single precision");
  const Clip empty{{"t0"}, {}, {}}, other, early{{"t0"}, {-1, 1}, {0, 1}},
      near{{"t0"}, {20000, 20000.0005}, {0, 1}};
  EXPECT_TRUE(failsWith(formatGlb(rig, {.clip = &near}), {"Keys about 20000.0005 s", "parts"}));
  EXPECT_TRUE(failsWith(formatGlb(rig, {.clip = &empty}), {"no frames"}));
  EXPECT_TRUE(failsWith(formatGlb(rig, {.clip = &early}), {"starts before 0"}));
  EXPECT_TRUE(failsWith(formatGlb(rig, {.clip = &other}), {"clip has 0 weights"}));
  Rig unseen = converted(scene());
  Rig nowhere = rig;
  unseen.scene = [] {
    Glb glb = scene();
    glb.json.erase("nodes");
    return read(glb).scene;
  }();
  const Motion both = motionOf(unseen, TimeLaw::newton);
  refuses(unseen, both, 0, "No node of the face's scene shows it");
}

TEST(AnimationWriter, WritesTheFramesWhereCurvesWouldBeLarger) {
  const Rig rig = converted(withTargets(plane(4, 4), 1));
  const Clip clip{{rig.targets[0].name}, {0, 1, 2, 3, 4}, {0, 1, 0.25, 0.875, 0}};
  const Written glb = write(rig, {.clip = &clip, .keyTolerance = 1e-3});
  const Json& sampler = lastAnimation(glb)["samplers"][0];
  EXPECT_EQ(sampler["interpolation"], "LINEAR");
  EXPECT_EQ(glb.numbers(sampler["output"]), clip.weights);
}

/// Floats near 20,000 are 1/512 apart, and players multiply slopes by the times that they read.
TEST(AnimationWriter, FitsSlopesToTimesAsFloatsHoldThem) {
  const Rig rig = converted(withTargets(plane(4, 4), 1));
  Clip clip{{rig.targets[0].name}, {}, {}};
  for (int f = 0; f <= 120; ++f) {
    clip.times.push_back(20'000 + f / 120.0);
    clip.weights.push_back(std::sin(6 * f / 120.0));
  }
  constexpr double kTolerance = 1e-3;
  const CubicKeys keys = fewestKeys(clip, kTolerance);
  const Written glb = write(rig, {.clip = &clip, .keyTolerance = kTolerance});
  const Json& sampler = lastAnimation(glb)["samplers"][0];
  ASSERT_EQ(sampler["interpolation"], "CUBICSPLINE");
  const auto times = glb.numbers(sampler["input"]), rows = glb.numbers(sampler["output"]);
  ASSERT_EQ(times.size(), keys.times.size());
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double span = times[k + 1] - times[k], exact = keys.times[k + 1] - keys.times[k];
    EXPECT_NEAR(span * rows[3 * k + 2], exact * keys.out[k], 1e-6) << "after key " << k;
    EXPECT_NEAR(span * rows[3 * k + 3], exact * keys.in[k + 1], 1e-6) << "before key " << k + 1;
  }
}

// ---- The head ----

Result<std::string> turning(const Rig& rig, double until = 1) {
  const Clip clip{{"open", "wink"}, {0, 1}, {0, 0, 1, 0}};
  const HeadTrack head{{0, until}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {}};
  return formatGlb(rig, {.clip = &clip, .head = &head});
}

TEST(AnimationWriter, TurnsTheJointsOfSkinnedMeshesAlone) {
  Glb source = smallFace();
  source.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"name", "hip"}}, {{"name", "hat"}}};
  source.add("skins", {{"joints", {1}}});
  source.add("scenes", {{"nodes", {0, 1, 2}}});
  const auto bytes = turning(converted(source));
  ASSERT_TRUE(bytes) << bytes.error().message;
  const Json json = Written(*bytes).json;
  const Json& shown = json["scenes"][0]["nodes"];
  ASSERT_EQ(shown, Json({3, 0})) << "a node above a skinned mesh means nothing";
  EXPECT_EQ(json["nodes"][3]["name"], "head");
  EXPECT_EQ(json["nodes"][4]["children"], Json({1, 2}));
}

TEST(AnimationWriter, TurnsSkinnedMeshesThatCarryOthers) {
  for (const int joint : {0, 1}) {
    Glb source = smallFace();
    source.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"name", "hip"}}};
    if (joint == 1) source.json["nodes"][0]["children"] = {1};
    source.add("skins", {{"joints", {joint}}});
    source.add("scenes", {{"nodes", {0}}});
    const Json json = Written(turning(converted(source)).value()).json;
    EXPECT_EQ(json["scenes"][0]["nodes"], Json({2}));
    EXPECT_EQ(json["nodes"][3]["children"], Json::array({0}));
  }
}

/// The angle about y to which players interpolate between the keys of a rotation track, the shorter
/// way.
double yawBetweenKeys(const std::vector<double>& times, const std::vector<double>& values,
                      double time) {
  std::size_t k = 1;
  while (k + 1 < times.size() && times[k] < time) ++k;
  const auto yaw = [&](std::size_t key) {
    return 2 * std::atan2(values[4 * key + 1], values[4 * key + 3]);
  };
  const double way = std::remainder(yaw(k) - yaw(k - 1), 2 * std::numbers::pi);
  return yaw(k - 1) + way * (time - times[k - 1]) / (times[k] - times[k - 1]);
}

TEST(AnimationWriter, TurnsTheHeadTheWayItGoesHoweverFar) {
  Glb source = smallFace();
  source.add("scenes", {{"nodes", {0}}});
  const Rig rig = converted(source);
  const Clip clip{{"open", "wink"}, {0, 2}, {0, 0, 1, 0}};
  HeadTrack head;
  for (int f = 0; f <= 120; ++f) {
    head.times.push_back(f / 60.0);
    head.rotations.push_back(quaternionOf({4 * f / 120.0, 0, 0}));
  }
  for (double& q : head.rotations.back()) q = -q;  // the same rotation
  GlbOptions options;
  options.clip = &clip, options.head = &head, options.keyTolerance = 0.001;
  const auto bytes = formatGlb(rig, options);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const Written glb(*bytes);
  const Json& animation = glb.json["animations"][0];
  const Json& sampler = animation["samplers"][animation["channels"].size() - 1];
  const auto times = glb.numbers(sampler["input"]), values = glb.numbers(sampler["output"]);
  EXPECT_LT(times.size(), 5u);
  for (std::size_t k = 4; k < values.size(); k += 4)
    EXPECT_GT(std::inner_product(&values[k - 4], &values[k], &values[k], 0.0), 0) << "a long way";
  for (double time = 0; time <= 2; time += 0.05)
    EXPECT_NEAR(
        std::remainder(yawBetweenKeys(times, values, time) - 2 * time, 2 * std::numbers::pi), 0,
        1.1e-3)
        << time;
}

TEST(AnimationWriter, TurnsTheHeadOfAFaceWithoutTargets) {
  Glb source = smallFace();
  source.add("scenes", {{"nodes", {0}}});
  source.primitive().erase("targets");
  const HeadTrack head{{0, 1}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {}};
  const Clip clip{{}, {0, 1}, {}};
  for (const Clip* with : {&clip, static_cast<const Clip*>(nullptr)}) {
    const auto bytes = formatGlb(converted(source), {.clip = with, .head = &head});
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(Written(*bytes).json["animations"][0]["channels"].size(), 1u);
  }
}

TEST(AnimationWriter, LeavesJointsTheirNames) {
  Glb source = smallFace();
  source.json["nodes"] = {{{"mesh", 0}}, {{"name", "head"}}};
  source.add("scenes", {{"nodes", {0, 1}}});
  const Json nodes = Written(turning(converted(source)).value()).json["nodes"];
  EXPECT_EQ(nodes[1]["name"], "head");
  EXPECT_EQ(nodes[2]["name"], "sweepface.head");
  EXPECT_EQ(nodes[3]["name"], "sweepface.head.contents");
  source.json["nodes"][1]["name"] = "head.contents";
  EXPECT_EQ(Written(turning(converted(source)).value()).json["nodes"][2]["name"], "sweepface.head");
}

TEST(AnimationWriter, TurnsNoNodeThatHangsElsewhereToo) {
  Glb source = smallFace();
  source.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}};
  source.add("scenes", {{"nodes", {1}}});
  const auto refuses = [&] {
    const auto bytes = turning(converted(source));
    return !bytes && bytes.error().message.contains("lists a node twice");
  };
  EXPECT_TRUE(refuses()) << "a child of another";
  source.json["scenes"][0]["nodes"] = {0};
  EXPECT_FALSE(refuses());
  source.json["scenes"][0]["nodes"] = {0, 0};
  EXPECT_TRUE(refuses()) << "twice";
}

TEST(AnimationWriter, TurnsTheHeadAtIncreasingTimesAlone) {
  Glb source = smallFace();
  source.add("scenes", {{"nodes", {0}}});
  EXPECT_TRUE(turning(converted(source), 1e-9));
  for (const double until : {0.0, -1.0})
    EXPECT_TRUE(failsWith(turning(converted(source), until), {"increasing times"}));
}

TEST(AnimationWriter, SaysWhereThereIsNothingToTurn) {
  Glb source = smallFace();
  source.add("scenes", {{"name", "empty"}});
  EXPECT_TRUE(
      failsWith(turning(converted(source)), {"shows nothing", "leave the head's turns out"}));
  source.add("scenes", {{"name", "another"}});
  EXPECT_TRUE(
      failsWith(turning(converted(source)), {"not just one scene", "leave the head's turns out"}));
}

}  // namespace
}  // namespace sweepface
