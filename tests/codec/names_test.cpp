#include <algorithm>
#include <gtest/gtest.h>
#include <random>

#include "codec/encoding.hpp"
#include "codec/limits.hpp"
#include "codec/name_coder.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using codec::NameCoder;
using codec::RangeDecoder;
using codec::RangeEncoder;
using codec::Symbols;
using Texts = std::vector<std::string>;

std::string coded(const Texts& names) {
  return codec::ranged([&](Symbols<RangeEncoder>& out) {
    NameCoder coder(out);
    for (const std::string& name : names) coder.code(name);
  });
}

Texts readBack(const std::string& bytes, std::size_t count) {
  RangeDecoder decoder(bytes);
  Symbols<RangeDecoder> in(decoder);
  NameCoder coder(in);
  Texts names;
  while (names.size() < count) names.push_back(coder.code(""));
  EXPECT_TRUE(in.ok());
  return names;
}

std::size_t sizeOf(const Texts& names) {
  const std::string bytes = coded(names);
  EXPECT_EQ(readBack(bytes, names.size()), names);
  return bytes.size();
}

/// ARKit's names as its documentation lists them, ending in "Left" and "Right" or otherwise.
Texts arkit(const std::string& left = "Left", const std::string& right = "Right") {
  Texts names;
  for (const auto& side : {left, right})
    for (const char* eye : {"Blink", "LookDown", "LookIn", "LookOut", "LookUp", "Squint", "Wide"})
      names.push_back(std::string("eye") + eye + side);
  for (const char* middle :
       {"jawForward", "jawLeft", "jawRight", "jawOpen", "mouthClose", "mouthFunnel", "mouthPucker",
        "mouthLeft", "mouthRight", "mouthRollLower", "mouthRollUpper", "mouthShrugLower",
        "mouthShrugUpper", "browInnerUp", "cheekPuff", "tongueOut"})
    names.push_back(middle);
  for (const char* pair :
       {"mouthSmile", "mouthFrown", "mouthDimple", "mouthStretch", "mouthPress", "mouthLowerDown",
        "mouthUpperUp", "browDown", "browOuterUp", "cheekSquint", "noseSneer"})
    for (const auto& side : {left, right}) names.push_back(pair + side);
  return names;
}

Texts sorted(Texts names) {
  std::ranges::sort(names);
  return names;
}

TEST(Names, UsualOnesCostHardlyAnything) {
  EXPECT_EQ(arkit().size(), 52u);
  EXPECT_LE(sizeOf(sorted(arkit())), 12u);
  EXPECT_LE(sizeOf(sorted(arkit("_L", "_R"))), 12u);
  EXPECT_LE(sizeOf(arkit()), 120u);
}

TEST(Names, OfOneKindCostLessThanTheirLetters) {
  const Texts names{"eyebrows-left-down",  "eyebrows-left-up",  "mouth-open",
                    "eyebrows-right-down", "eyebrows-right-up", "mouth-compression"};
  EXPECT_LE(sizeOf(names), 52u);
}

TEST(Names, LikeNoneBeforeCostNoMoreThanTheirLetters) {
  std::mt19937 random(3);
  Texts names(40);
  for (std::string& name : names)
    while (name.size() < 14) name += static_cast<char>('0' + random() % 64);
  EXPECT_LE(sizeOf(names), 40u * 14);
}

TEST(Names, OfAnyBytesComeBack) {
  Texts names{"", "", std::string(4096, 'x'), "x", std::string(4096, 'x')};
  for (int c = 1; c < 256; ++c) names.push_back(std::string(3, static_cast<char>(c)) + "eyeBlink");
  EXPECT_EQ(readBack(coded(names), names.size()), names);
}

TEST(Names, TooLongOnesAreRefused) {
  const std::string bytes = coded({std::string(4097, 'x')});
  RangeDecoder decoder(bytes);
  Symbols<RangeDecoder> in(decoder);
  NameCoder(in).code("");
  EXPECT_FALSE(in.ok());
}

// Letters that repeat as before take hardly any bytes.
TEST(Names, CountTowardsTheMemoryThatAFileMayTake) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.targets.resize(1);
  const std::string little = encode(rig);
  rig.targets[0].name = std::string(4000, 'x');
  const std::string much = encode(rig);
  std::size_t memory = 1;
  while (!decode(little, "a.sweep", {memory})) memory += 1000;
  EXPECT_LE(much.size(), little.size() + 20);
  EXPECT_FALSE(decode(much, "a.sweep", {memory}));
  EXPECT_TRUE(decode(much, "a.sweep", {memory + 4000 * codec::kBytesALetter}));
}

}  // namespace
}  // namespace sweepface
