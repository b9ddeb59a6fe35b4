#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "codec/packed.hpp"
#include "codec/rigs.hpp"
#include "codec/version1.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// A file of version 1 with a chunk of every kind. It must be read like this for ever.
constexpr std::string_view kHex =
    "5357454550464301484541440b0000008632e2568d28ed0dbe30893f04030257495245240000005f"
    "b1ff2404040201020102010201040002020002020202040102010005020201010001040106010253"
    "4841501a00000038fdc6ee0202000000000000f03f000000000000e0bf000000000000d03f4e4555"
    "54310000009533c02d000000000000e0fd3f00c002bf0000edbf00007d3f0060cc3f0020b3bf0040"
    "9ebf0000dc3f00404b3f0020f6bf008098be544152474200000023bde0ec046f70656e0000a0df3f"
    "00c03d3f0000f8bf000078be0000004000008cbe0000f7bf0040453f0080dd3f00c09bbf0060b5bf"
    "0080ca3f04090000008094ebdc030002544152472200000045b960aa0777696e6b20c3a9010200e0"
    "ce3f00c0753f0080eebf04090000008094ebdc03000254415247090000002153617b047265737401"
    "0001006c6f6f733100000073c9363c02555555555555d53f9a9999999999c93f333333333333d33f"
    "0000000000001040000000000000144000000000000018406f72647207000000cb7f13e506060303"
    "030303706f6c7926000000ceda32dd010801060101010204736b696e000101010104686561640100"
    "01010a6120666163652e6d746c74657863100000005e1deb3c040402001432003200320001000402"
    "0271756164010000007861f51600454e442000000000107df158";

std::string goldenBytes() {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (std::size_t k = 0; k < kHex.size(); k += 2)
    bytes += static_cast<char>(16 * digit(kHex[k]) + digit(kHex[k + 1]));
  return bytes;
}

Rig goldenRig() {
  Wireframe wireframe = onePatch(1, 1);
  for (Node& node : wireframe.nodes) node.stored = kPosition;
  return dressed(makeRig(wireframe));
}

TEST(Golden, OfVersion1IsWhatTheTestsOfVersion1Write) {
  EXPECT_EQ(encodeVersion1(goldenRig()), goldenBytes());
}

TEST(Golden, OfVersion1IsRead) {
  const auto rig = decode(goldenBytes(), "golden.sweep");
  ASSERT_TRUE(rig) << rig.error().message;
  expectEqual(*rig, goldenRig());
}

// A file of version 2 with a chunk of nearly every kind, read and written like this for ever.
std::string goldenVersion2() {
  std::ifstream file(SWEEPFACE_SOURCE_DIR "/tests/codec/golden_version2.sweep", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Golden, OfVersion2IsRead) {
  const auto rig = decode(goldenVersion2(), "golden.sweep");
  ASSERT_TRUE(rig) << rig.error().message;
  expectEqual(*rig, everything());
  EXPECT_EQ(rig->packing, everything().packing);
}

TEST(Golden, OfVersion2IsWrittenByteForByte) {
  EXPECT_EQ(encode(everything()), goldenVersion2());
  EXPECT_EQ(encode(decode(goldenVersion2(), "golden.sweep").value()), goldenVersion2());
}

// What turns is told by a chunk that older programs skip: all before and behind it is as it was.
TEST(Golden, TurnsAreOneChunkMore) {
  const std::string with = encode(withTurns(everything())), without = encode(everything());
  const std::size_t end = without.rfind("END ");
  EXPECT_EQ(with.substr(0, end), without.substr(0, end));
  EXPECT_EQ(with.substr(end, 4), "turn");
  EXPECT_EQ(with.size(), without.size() + 12 + 1 + 2 * (1 + 12) + 12);
}

}  // namespace
}  // namespace sweepface
