#include <gtest/gtest.h>
#include <map>

#include "codec/files.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"
#include "codec/version1.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

std::map<std::string, std::size_t> partsOf(const std::string& bytes) {
  std::map<std::string, std::size_t> parts;
  const auto listed = fileParts(bytes, "a.sweep").value();
  for (const FilePart& part : listed) {
    EXPECT_FALSE(parts.contains(part.name)) << part.name;
    parts[part.name] = part.bytes;
  }
  return parts;
}

TEST(Parts, SumToTheFile) {
  for (const Rig& rig : someRigs()) {
    const std::string bytes = encode(rig);
    std::size_t sum = 0;
    for (const auto& [name, size] : partsOf(bytes)) sum += size;
    EXPECT_EQ(sum, bytes.size());
  }
}

TEST(Parts, HaveTheNamesOfWhatTheyHold) {
  const auto parts = partsOf(encodeVersion1(withScene(dressed(makeRig(onePatch(1, 1))))));
  for (const char* name :
       {"container", "wireframe", "shape parameters", "neutral", "targets", "loose vertices",
        "source order", "polygons", "texture coordinates", "quad corners", "scene"})
    EXPECT_TRUE(parts.contains(name)) << name;
  EXPECT_EQ(parts.size(), 11u);
  EXPECT_EQ(partsOf(encode(makeRig(onePatch(1, 1)))).contains("loose vertices"), false);
}

TEST(Parts, OfWhatVersion2HoldsHaveTheirNames) {
  const auto parts = partsOf(encode(withTurns(everything())));
  for (const char* name :
       {"container", "wireframe", "names", "neutral", "targets", "exact vectors", "loose vertices",
        "source order", "polygons", "texture coordinates", "scene", "turns"})
    EXPECT_TRUE(parts.contains(name)) << name;
  EXPECT_EQ(parts.size(), 12u);
}

TEST(Parts, CountWhatIsUnknown) {
  auto chunks = takeApart(encode(makeRig(onePatch(1, 1))));
  chunks.insert(chunks.begin(), {"hair", "12345"});
  EXPECT_EQ(partsOf(putTogether(chunks)).at("unknown"), 5u);
}

TEST(Parts, AreRefusedForADamagedFile) {
  std::string bytes = encode(makeRig(onePatch(1, 1)));
  bytes[60] ^= 1;
  EXPECT_FALSE(fileParts(bytes, "a.sweep"));
  EXPECT_FALSE(fileParts("", "a.sweep"));
}

TEST(Sizes, ATargetThatMovesNothingCostsItsNameAndHardlyAnything) {
  Rig rig = makeRig(onePatch(8, 8));
  const std::string before = encode(rig);
  rig.targets.push_back({"nothing", std::vector<Vec3>(rig.neutral.size()), {}});
  EXPECT_LE(encode(rig).size() - before.size(), 8 + 2u);
}

TEST(Sizes, AQuadOfTheSourceCostsLessThanAByte) {
  const Rig rig = makeRig(onePatch(40, 50));
  const auto parts = partsOf(encode(rig));
  EXPECT_LE(parts.at("polygons"), 2000u);
  EXPECT_LE(parts.at("source order"), 2091u / 4);
}

}  // namespace
}  // namespace sweepface
