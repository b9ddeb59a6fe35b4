#include <gtest/gtest.h>

#include "sweepface/clip.hpp"

namespace sweepface {
namespace {

using Texts = std::vector<std::string>;
using Drives = std::vector<std::pair<std::string, double>>;

const Texts kTargets{"mouth-open", "smile", "puff"};

Drives drivesOf(const NameMap& map, std::string_view name) {
  Drives found;
  for (const auto& [key, drives] : map.drives)
    if (key == name)
      for (const auto& [target, factor] : drives) found.emplace_back(target, factor);
  return found;
}

/// Three names at two times.
Clip threeNames() {
  return {{"JawOpen", "mouthSmile_L", "mouthSmileRight"}, {0, 1}, {0, 0.5, 1, 1, 0.25, 0}};
}

Result<Clip> mapped(const char* text, Clip clip = threeNames()) {
  const auto map = parseNameMap(text, "names.json");
  if (!map) return std::unexpected(map.error());
  return renamed(std::move(clip), *map, kTargets);
}

TEST(NameMaps, AreTextsListsAndNumbers) {
  const NameMap map =
      parseNameMap(R"({"a": "smile", "b": ["smile", "puff"], "c": {"puff": -0.5}, "d": null})", "m")
          .value();
  EXPECT_EQ(map.called, "m");
  EXPECT_EQ(drivesOf(map, "a"), (Drives{{"smile", 1}}));
  EXPECT_EQ(drivesOf(map, "b"), (Drives{{"smile", 1}, {"puff", 1}}));
  EXPECT_EQ(drivesOf(map, "c"), (Drives{{"puff", -0.5}}));
  EXPECT_EQ(drivesOf(map, "d"), Drives{});
}

TEST(NameMaps, GiveTargetsTheSumOfWhatDrivesThem) {
  const Clip clip = mapped(R"({"jawOpen": ["mouth-open", "puff"], "mouthSmileLeft": {"smile": 0.5},
                               "mouthSmileRight": {"smile": 0.25, "puff": 2}})")
                        .value();
  EXPECT_EQ(clip.names, (Texts{"mouth-open", "puff", "smile"}));
  EXPECT_EQ(clip.weights, (std::vector{0.0, 2.0, 0.5, 1.0, 1.0, 0.125}));
  EXPECT_EQ(clip.times, threeNames().times);
  EXPECT_TRUE(clip.warnings.empty());
}

TEST(NameMaps, LeaveOtherNamesAlone) {
  const Clip clip = mapped(R"({"jaw_open": "puff", "mouthSmileLeft": null})").value();
  EXPECT_EQ(clip.names, (Texts{"mouthSmileRight", "puff"}));
  EXPECT_EQ(clip.weights, (std::vector{1.0, 0.0, 0.0, 1.0}));
}

TEST(NameMaps, AddToWhatDrivesATargetByItsOwnName) {
  const Clip clip = mapped(R"({"jawOpen": {"smile": -0.5}, "mouthSmileRight": null})",
                           {{"JawOpen", "Smile", "mouthSmileRight"}, {0}, {1, 0.75, 1}})
                        .value();
  EXPECT_EQ(clip.names, Texts{"smile"});
  EXPECT_EQ(clip.weights, std::vector{0.25});
}

TEST(NameMaps, TakeTheLargerOfTwoSidesForANameWithoutOne) {
  const Clip clip =
      mapped(R"({"eyeBlink": "smile"})", {{"eyeBlink_L", "eyeBlink_R"}, {0}, {0.9, 0.1}}).value();
  EXPECT_EQ(clip.names, Texts{"smile"});
  EXPECT_EQ(clip.weights, std::vector{0.9});
}

TEST(NameMaps, KeepANameWithoutASideApartFromATargetOfOneSide) {
  const auto map = parseNameMap(R"({"jawOpen": "smile_L"})", "names.json").value();
  const Texts targets{"smile_L", "smile_R"};
  const Clip clip = renamed({{"jawOpen", "smile"}, {0}, {0.25, 0.5}}, map, targets).value();
  EXPECT_EQ(clip.names, (Texts{"smile", "smile_L"}));
  EXPECT_EQ(clip.weights, (std::vector{0.5, 0.25}));
}

TEST(NameMaps, TellWhichOfTheirNamesTheClipLacks) {
  const Clip clip = mapped(R"({"jawOpen": "smile", "beard": "puff", "tail": null})").value();
  EXPECT_EQ(clip.names, (Texts{"mouthSmile_L", "mouthSmileRight", "smile"}));
  EXPECT_EQ(clip.warnings, Texts{"names.json: the clip has no beard, tail."});
  const Clip many = mapped(R"({"a": null, "b": null, "c": null, "d": null, "e": null, "f": null,
                               "g": null, "h": null})")
                        .value();
  EXPECT_EQ(many.warnings, Texts{"names.json: the clip has no a, b, c, d, e, f and 2 more."});
}

TEST(NameMaps, RefuseWhatCannotBeMeant) {
  const auto refuses = [](const char* text, std::string_view part) {
    const auto clip = mapped(text);
    ASSERT_FALSE(clip) << text;
    EXPECT_NE(clip.error().message.find(part), std::string::npos) << clip.error().message;
  };
  refuses("{", "names.json, line 1");
  refuses("[]", "names.json is no object that has targets by names of a clip.");
  refuses("{}", "is no object");
  refuses(R"({"jawOpen": "smile", "jaw_open": "puff"})",
          "'jawOpen' and 'jaw_open' are one name of the clip; keep one.");
  refuses(R"({"jawOpen": "smile", "puff": null, "jawOpen": "puff"})",
          "names.json has the key 'jawOpen' twice in one object; keep one.");
  refuses(R"({"jawOpen": 1})", "names.json: 'jawOpen' is neither a target's name, a list");
  refuses(R"({"jawOpen": ["smile", 2]})", "'jawOpen' is neither");
  refuses(R"({"jawOpen": {"smile": "much"}})", "drives 'smile' by what is no number within");
  refuses(R"({"jawOpen": {"smile": 1001}})", "drives 'smile' by what is no number within");
  refuses(R"({"jawOpen": "smil"})", "'jawOpen' drives 'smil', which is no target of the face.");
  Clip wild = threeNames();
  wild.weights[0] = 5e5;
  const auto clip = mapped(R"({"jawOpen": {"smile": -3}})", wild);
  ASSERT_FALSE(clip);
  EXPECT_EQ(clip.error().message, "names.json: 'smile' would get a weight beyond ±1,000,000.");
}

}  // namespace
}  // namespace sweepface
