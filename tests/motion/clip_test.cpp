#include "sweepface/clip.hpp"

#include <array>
#include <gtest/gtest.h>

namespace sweepface {
namespace {

Clip ramp() { return {{"jawOpen"}, {10, 11, 13}, {0, 1, 0}}; }

double at(const Clip& clip, double seconds) {
  std::array<double, 1> out{};
  clip.at(seconds, out);
  return out[0];
}

TEST(Clip, RunsStraightBetweenFramesAndHoldsItsEnds) {
  EXPECT_EQ(ramp().seconds(), 3);
  EXPECT_EQ(at(ramp(), -1), 0);
  EXPECT_EQ(at(ramp(), 0.25), 0.25);
  EXPECT_EQ(at(ramp(), 1), 1);
  EXPECT_EQ(at(ramp(), 2), 0.5);
  EXPECT_EQ(at(ramp(), 9), 0);
}

TEST(Clip, WithoutFramesIsZero) { EXPECT_EQ(at(Clip{{"a"}, {}, {}}, 1), 0); }

std::vector<std::vector<Index>> matched(std::vector<std::string> names,
                                        const std::vector<std::string>& targets) {
  return matchClip({std::move(names), {}, {}}, targets).targets;
}

TEST(ClipMatch, SpellingsOfOneShapeAreTheSame) {
  const std::vector<std::string> targets{"eyeBlink_L", "eyeBlink_R", "jawOpen", "mouthLeft"};
  EXPECT_EQ(matched({"EyeBlinkLeft", "eye_blink_right", "JawOpen", "mouthLeft"}, targets),
            (std::vector<std::vector<Index>>{{0}, {1}, {2}, {3}}));
  EXPECT_EQ(matched({"eyeBlink_R", "eyeBlinkL", "eye-blink-r", "eyeBlink.L"}, targets),
            (std::vector<std::vector<Index>>{{1}, {0}, {1}, {0}}));
}

TEST(ClipMatch, ANameWithoutASideDrivesBoth) {
  EXPECT_EQ(matched({"browInnerUp"}, {"browInnerUp_L", "jawOpen", "browInnerUp_R"}),
            (std::vector<std::vector<Index>>{{0, 2}}));
  EXPECT_EQ(matched({"jaw", "Mouth"}, {"jawLeft", "jawRight", "mouthLeft", "mouth_R"}),
            (std::vector<std::vector<Index>>{{}, {}}))
      << "these go there";
}

TEST(ClipMatch, AFinalLetterIsNotASide) {
  EXPECT_EQ(matched({"curl", "PURL"}, {"cur_L", "pur_L"}),
            (std::vector<std::vector<Index>>{{}, {}}));
}

TEST(ClipMatch, WhatAllTargetsBeginWithMayBeLeftOut) {
  using Targets = std::vector<std::vector<Index>>;
  EXPECT_EQ(matched({"jawOpen", "EyeBlinkLeft", "eyeBlink", "mouth", "Head", "head jaw open"},
                    {"Head.jawOpen", "Head.eye_blink_L", "Head.eye_blink_R", "Head.mouthLeft"}),
            (Targets{{0}, {1}, {2}, {}, {}, {0}}));
  EXPECT_EQ(matched({"open", "eyeOpen"}, {"eye_open", "eye_shut"}), (Targets{{0}, {0}}));
  EXPECT_EQ(matched({"open"}, {"eyeOpen", "eyeShut"}), (Targets{{}})) << "no separator";
  EXPECT_EQ(matched({"open", "b"}, {"a:open", "open", "b"}), (Targets{{1}, {2}})) << "not in all";
  EXPECT_EQ(matched({"b:up"}, {"a:", "a:b:up", "a:b:"}), (Targets{{}})) << "not a whole name";
  EXPECT_EQ(matched({"up"}, {"a:up"}), (Targets{{}})) << "one name has nothing in common";
  EXPECT_EQ(matched({"a"}, {"", "x:a", "x:b"}), (Targets{{}}));
}

TEST(ClipMatch, SaysWhatDrivesNothingAndWhatNothingDrives) {
  const ClipMatch match =
      matchClip({{"jawOpen", "headYaw"}, {}, {}}, std::vector<std::string>{"jawOpen", "smile"});
  EXPECT_EQ(match.unmatched, std::vector<std::string>{"headYaw"});
  EXPECT_EQ(match.undriven, std::vector<std::string>{"smile"});
}

TEST(ClipMatch, ANameOfItsOwnDrivesASideAlone) {
  const std::vector<std::string> targets{"up_L", "up_R"};
  EXPECT_EQ(matched({"up", "upLeft"}, targets), (std::vector<std::vector<Index>>{{1}, {0}}));
  EXPECT_EQ(matched({"up_R", "up", "up_L"}, targets),
            (std::vector<std::vector<Index>>{{1}, {}, {0}}));
}

TEST(ClipMatch, SpreadsWeightsOverTargets) {
  const std::vector<std::string> targets{"up_L", "up_R", "jaw"};
  const Clip clip{{"upRight", "upLeft"}, {3, 4}, {0.3, 0.7, -0.3, -0.1}};
  const ClipMatch match = matchClip(clip, targets);
  std::array<double, 3> to{9, 9, 9};
  match.spread(clip, 0, to);
  EXPECT_EQ(to, (std::array{0.7, 0.3, 0.0}));
  match.spread(clip, 0.25, to);
  EXPECT_DOUBLE_EQ(to[0], 0.5);
  EXPECT_DOUBLE_EQ(to[1], 0.15);
  match.spread(clip, 9, to);  // negative, as when springs overshoot
  EXPECT_EQ(to, (std::array{-0.1, -0.3, 0.0}));
  // If several names match one target, the largest weight counts.
  const Clip twice{{"jaw", "Jaw"}, {0}, {-0.3, -0.1}};
  matchClip(twice, targets).spread(twice, 0, to);
  EXPECT_EQ(to, (std::array{0.0, 0.0, -0.1}));
  const Clip empty{{"jaw"}, {}, {}};
  matchClip(empty, targets).spread(empty, 0, to);
  EXPECT_EQ(to, (std::array{0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace sweepface
