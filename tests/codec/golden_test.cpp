#include <gtest/gtest.h>
#include <sstream>

#include "codec/digest.hpp"
#include "codec/files.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"
#include "codec/version1.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// One file of each version, with a chunk of nearly every kind. They must be read like this for
// ever.
std::string goldenVersion1() { return goldenFile("golden_version1.sweep"); }
std::string goldenVersion2() { return goldenFile("golden_version2.sweep"); }

Rig goldenRig() {
  Wireframe wireframe = onePatch(1, 1);
  for (Node& node : wireframe.nodes) node.stored = kPosition;
  return dressed(makeRig(wireframe));
}

TEST(Golden, OfVersion1IsWhatTheTestsOfVersion1Write) {
  EXPECT_EQ(encodeVersion1(goldenRig()), goldenVersion1());
}

TEST(Golden, OfVersion1IsRead) {
  const auto rig = decode(goldenVersion1(), "golden.sweep");
  ASSERT_TRUE(rig) << rig.error().message;
  expectEqual(*rig, goldenRig());
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

// Some numbers at which searches end are part of the format.
TEST(Golden, OfWhatIsBeyondTheEndsOfSearchesIsWrittenByteForByte) {
  EXPECT_EQ(encode(spokes()), goldenFile("golden_spokes.sweep"));
  EXPECT_EQ(encode(hub()), goldenFile("golden_hub.sweep"));
  EXPECT_EQ(encode(disorder()), goldenFile("golden_disorder.sweep"));
}

// The digests must not depend on the compiler; web/test/identity.test.js expects the same of
// WebAssembly.
// The sample is what `convert --pack --tolerance 0.3 --strip order,uv` makes of the sample face
// with six expressions: predicted from its neutral, mirrored, with T-nodes and curved ribbons.
// The parts are two spheres that turn, a plate with a hole and a fan, packed: poles, bones, loose
// vertices, polygons, and sites without an image at nodes that have one. The rest is beyond the
// numbers at which searches end.
TEST(Golden, DigestsAreTheSameEverywhere) {
  std::istringstream list(goldenFile("golden_digests.txt"));
  int files = 0;
  for (std::string name, expected; list >> name && std::getline(list >> std::ws, expected);
       ++files) {
    const auto rig = decode(goldenFile(name), name);
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(digestsOf(*rig), expected) << name;
  }
  EXPECT_EQ(files, 7);
}

// Turns are stored in a chunk that older programs skip; nothing before or after it changes.
TEST(Golden, TurnsAreOneChunkMore) {
  const std::string with = encode(withTurns(everything())), without = encode(everything());
  const std::size_t end = without.rfind("END ");
  EXPECT_EQ(with.substr(0, end), without.substr(0, end));
  EXPECT_EQ(with.substr(end, 4), "turn");
  EXPECT_EQ(with.size(), without.size() + 12 + 1 + 2 * (1 + 12) + 12);
}

}  // namespace
}  // namespace sweepface
