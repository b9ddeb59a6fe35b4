#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "codec/symbols.hpp"

namespace sweepface::codec {
namespace {

struct CodedBit {
  bool bit = false;
  std::uint32_t one = 0;
};

// Random bits, drawn with the probabilities that the coder is given.
std::vector<CodedBit> someBits(std::size_t count, std::uint32_t low, std::uint32_t high) {
  std::mt19937 random(7);
  std::vector<CodedBit> bits;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t one = low + static_cast<std::uint32_t>(random()) % (high - low);
    bits.push_back({static_cast<std::uint32_t>(random()) % 65536 < one, one});
  }
  return bits;
}

std::string coded(const std::vector<CodedBit>& bits) {
  RangeEncoder out;
  for (const auto& [bit, one] : bits) out.code(bit, one);
  return out.finish();
}

TEST(RangeCoder, GivesBackEveryBit) {
  for (const auto& [low, high] : {std::pair{1u, 65536u}, {1u, 3u}, {65533u, 65536u}}) {
    const auto bits = someBits(20000, low, high);
    const std::string bytes = coded(bits);
    RangeDecoder in(bytes);
    for (const auto& [bit, one] : bits) ASSERT_EQ(in.code(false, one), bit);
    EXPECT_TRUE(in.exhausted());
  }
}

TEST(RangeCoder, TakesHardlyMoreThanTheEntropy) {
  for (const auto& [low, high] : {std::pair{1u, 65536u}, {600u, 700u}, {32768u, 32769u}}) {
    const auto bits = someBits(100000, low, high);
    double ideal = 0;
    for (const auto& [bit, one] : bits) ideal -= std::log2((bit ? one : 65536 - one) / 65536.0);
    EXPECT_LE(8.0 * static_cast<double>(coded(bits).size()), 1.001 * ideal + 32);
    EXPECT_GE(8.0 * static_cast<double>(coded(bits).size()), 0.999 * ideal - 32);
  }
}

TEST(RangeCoder, ReadsZerosBeyondTheEnd) {
  RangeDecoder in("");
  for (int k = 0; k < 1000; ++k) in.code(false, 1234);
  EXPECT_TRUE(in.exhausted());
}

TEST(Mixing, LearnsWhatIsRegular) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  for (int k = 0; k < 8000; ++k) out.bit(1, 0, 0, k % 50 == 0);
  // The entropy is 0.1414 bits each; learning that takes a few more.
  EXPECT_LE(coder.finish().size(), 8000 * 0.1414 / 8 * 1.1 + 20);
}

TEST(Symbols, GiveBackNumbersOfAnySize) {
  std::vector<std::uint64_t> numbers{0, 1, 2, 3, 254, 255, 256, 65535, 0x7fffffff, 0xfffffffe};
  std::vector<std::int64_t> signedNumbers{0, 1, -1, 2, -2, 100, -100, INT32_MAX, INT32_MIN + 1};
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  for (const auto n : numbers) out.number(1, 0, 0, n);
  for (const auto n : signedNumbers) out.signedNumber(3, 0, 0, n);
  out.index(5, 1000, 999);
  out.raw(6, 0x123456789abcdef0);
  const std::string bytes = coder.finish();
  RangeDecoder decoder(bytes);
  Symbols<RangeDecoder> in(decoder);
  for (const auto n : numbers) EXPECT_EQ(in.number(1, 0, 0, 0), n);
  for (const auto n : signedNumbers) EXPECT_EQ(in.signedNumber(3, 0, 0, 0), n);
  EXPECT_EQ(in.index(5, 1000, 0), 999u);
  EXPECT_EQ(in.raw(6, 0), 0x123456789abcdef0u);
  EXPECT_TRUE(in.ok());
}

TEST(Symbols, LearnWhatFollowsWhat) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  const std::string_view pattern = "0110100";
  for (std::size_t k = 0; k < 700; ++k) out.bit(1, 0, 0, pattern[k % pattern.size()] == '1');
  EXPECT_LE(coder.finish().size(), 12u);  // 86 if the bits were independent
}

TEST(Symbols, RefuseAnIndexOutOfRange) {
  RangeEncoder coder;
  Symbols<RangeEncoder> out(coder);
  out.index(5, 1024, 1000);
  const std::string bytes = coder.finish();
  RangeDecoder decoder(bytes);
  Symbols<RangeDecoder> in(decoder);
  in.index(5, 1000, 0);
  EXPECT_FALSE(in.ok());
}

}  // namespace
}  // namespace sweepface::codec
