#include <gtest/gtest.h>

#include "codec/files.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"
#include "codec/version1.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// Small files of version 2, some of them packed.
std::vector<std::string> rangeCodedFiles() {
  std::vector<std::string> files;
  for (const Rig& rig : someRigs()) files.push_back(encode(rig));
  for (const Rig& rig : {packed(dressed(makeRig(tee()))), everything()})
    files.push_back(encode(rig));
  return files;
}

/// Small files of both versions.
std::vector<std::string> someFiles() {
  std::vector<std::string> files = rangeCodedFiles();
  for (const Rig& rig : someRigs()) files.push_back(encodeVersion1(rig));
  return files;
}

void expectRefused(const std::string& bytes, std::string_view because) {
  const auto rig = decode(bytes, "a.sweep");
  ASSERT_FALSE(rig) << "expected: " << because;
  EXPECT_TRUE(rig.error().message.starts_with("a.sweep")) << rig.error().message;
  EXPECT_NE(rig.error().message.find(because), std::string::npos) << rig.error().message;
}

/// The rig can be evaluated and encoded like any other.
void expectSound(const Rig& rig) {
  const Weights weights(rig.targets.size(), 1.0);
  const Tessellation grid(rig.surface, 1);
  const auto vertices = sourcePositions(rig, grid, blend(rig, weights), weights);
  EXPECT_EQ(vertices.size(), rig.source.gridVertex.size());
  const bool hasOrder = !rig.source.gridVertex.empty();
  const Index most = hasOrder ? static_cast<Index>(vertices.size()) : grid.vertexCount();
  for (Index v : rig.source.polygons.corners) EXPECT_LT(v, most);
  const std::string bytes = encode(rig);
  EXPECT_EQ(encode(decode(bytes, "again.sweep").value()), bytes);
}

TEST(Damage, EveryTruncationIsRefused) {
  for (const std::string& bytes : someFiles())
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_FALSE(decode(std::string_view(bytes).substr(0, size), "a.sweep")) << size;
}

TEST(Damage, EveryFlippedBitIsRefused) {
  for (std::string bytes : someFiles())
    for (std::size_t k = 0; k < 8 * bytes.size(); ++k) {
      bytes[k / 8] ^= static_cast<char>(1 << k % 8);
      EXPECT_FALSE(decode(bytes, "a.sweep")) << "bit " << k;
      bytes[k / 8] ^= static_cast<char>(1 << k % 8);
    }
}

// Flips every `stride`-th bit of all payloads, one at a time.
void expectSoundOrNone(const std::vector<std::string>& files, std::size_t stride) {
  std::size_t accepted = 0, refused = 0;
  for (const std::string& bytes : files) {
    auto chunks = takeApart(bytes);
    for (FileChunk& chunk : chunks)
      for (std::size_t k = 0; k < 8 * chunk.payload.size(); k += stride) {
        chunk.payload[k / 8] ^= static_cast<char>(1 << k % 8);
        const auto changed = decode(putTogether(chunks), "a.sweep");
        if (changed) expectSound(*changed);
        ++(changed ? accepted : refused);
        chunk.payload[k / 8] ^= static_cast<char>(1 << k % 8);
      }
  }
  EXPECT_GT(accepted, 1000u);  // such as bits of coordinates
  EXPECT_GT(refused, 1000u);   // such as bits of counts and indices
}

TEST(Damage, AFlippedBitUnderAMatchingChecksumLeavesASoundRigOrNone) {
  expectSoundOrNone(someFiles(), 7);
}
TEST(DamageLong, EveryFlippedBitUnderAMatchingChecksumLeavesASoundRigOrNone) {
  expectSoundOrNone(someFiles(), 1);
}

TEST(Damage, EveryTruncationOfAPayloadIsRefused) {
  for (const Rig& rig : someRigs()) {
    auto chunks = takeApart(encodeVersion1(rig));
    for (FileChunk& chunk : chunks) {
      const std::string whole = chunk.payload;
      for (std::size_t size = 0; size < whole.size(); ++size) {
        chunk.payload = whole.substr(0, size);
        EXPECT_FALSE(decode(putTogether(chunks), "a.sweep")) << chunk.code << size;
      }
      chunk.payload = whole;
    }
  }
}

// A range decoder reads missing bytes as zeros, so a truncated payload may still be valid.
TEST(Damage, ATruncatedRangeCodedPayloadLeavesASoundRigOrNone) {
  for (const std::string& bytes : rangeCodedFiles()) {
    auto chunks = takeApart(bytes);
    for (FileChunk& chunk : chunks) {
      const std::string whole = chunk.payload;
      for (std::size_t size = 0; size < whole.size(); ++size) {
        chunk.payload = whole.substr(0, size);
        if (const auto changed = decode(putTogether(chunks), "a.sweep")) expectSound(*changed);
      }
      chunk.payload = whole;
    }
  }
}

TEST(Damage, AByteAfterTheLastValueOfAPayloadIsRefused) {
  for (const std::string& bytes : someFiles()) {
    auto chunks = takeApart(bytes);
    for (FileChunk& chunk : chunks) {
      chunk.payload += '\0';
      EXPECT_FALSE(decode(putTogether(chunks), "a.sweep")) << chunk.code;
      chunk.payload.pop_back();
    }
  }
}

TEST(Damage, MessagesSayWhatIsWrongAndWhatToDo) {
  const std::string bytes = encodeVersion1(makeRig(onePatch(1, 1)));
  const auto at = [&](std::size_t k, char value) {
    std::string changed = bytes;
    changed[k] = value;
    return changed;
  };
  expectRefused("", "a.sweep is empty; convert the source again.");
  expectRefused("v 0 0 0\n",
                "a.sweep does not begin with SWEEPFC; check that it is a .sweep file.");
  expectRefused("SWEEPFC",
                "a.sweep, byte 7: the file ends before its version; copy the file again");
  expectRefused(at(7, 0), "a.sweep is of version 0 and this program reads versions 1 to 2");
  expectRefused(at(7, 3),
                "a.sweep is of version 3 and this program reads versions 1 to 2; get a program");
  expectRefused(bytes.substr(0, 30),
                "byte 8: the file ends within chunk 'HEAD'; copy the file again");
  expectRefused(bytes.substr(0, bytes.size() - 12), "the file ends before its last chunk");
  expectRefused(at(25, 'x'), "byte 8: the checksum of chunk 'HEAD' does not match");
  expectRefused(at(8, 7), "byte 8: there is no chunk where one must begin");
  expectRefused(bytes + "x", "the file goes on after its last chunk");
}

TEST(Damage, UnknownOptionalChunksAreSkippedWhereverTheyAre) {
  const Rig rig = makeRig(twoPatches());
  const auto chunks = takeApart(encode(rig));
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    for (const char* code : {"hair", "1air", "~AIR"}) {
      auto more = chunks;
      more.insert(more.begin() + static_cast<std::ptrdiff_t>(k), {code, "anything"});
      const auto back = decode(putTogether(more), "a.sweep");
      ASSERT_TRUE(back) << back.error().message;
      expectEqual(*back, rig);
    }
  }
}

TEST(Damage, UnknownRequiredChunksAreRefused) {
  auto chunks = takeApart(encodeVersion1(makeRig(onePatch(1, 1))));
  chunks.insert(chunks.begin() + 3, {"HAIR", "anything"});
  expectRefused(putTogether(chunks), "chunk 'HAIR' is required and unknown to this program");
}

TEST(Damage, ChunksThatAreMissingTwiceThereOrOutOfOrderAreRefused) {
  const auto chunks = takeApart(encodeVersion1(dressed(makeRig(onePatch(1, 1)))));
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    auto changed = chunks;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(k), chunks[k]);
    EXPECT_FALSE(decode(putTogether(changed), "a.sweep")) << "twice: " << chunks[k].code;
    if (k + 1 < chunks.size() && chunks[k].code != chunks[k + 1].code) {
      changed = chunks;
      std::swap(changed[k], changed[k + 1]);
      EXPECT_FALSE(decode(putTogether(changed), "a.sweep")) << "swapped: " << chunks[k].code;
    }
    changed = chunks;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(k));
    if (chunks[k].code == "texc" || chunks[k].code == "quad") continue;  // nothing depends on them
    EXPECT_FALSE(decode(putTogether(changed), "a.sweep")) << "without: " << chunks[k].code;
  }
}

TEST(Damage, WhatIsAnnouncedMustFollow) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.source = {};
  rig.source.loose = {{1, 2, 3}};
  for (Target& target : rig.targets) target.looseDifference = {{0, 1, 0}};
  const auto chunks = takeApart(encode(packed(std::move(rig))));
  const auto without = [&](std::initializer_list<std::string_view> codes) {
    auto left = chunks;
    std::erase_if(left, [&](const FileChunk& chunk) {
      return std::ranges::find(codes, chunk.code) != codes.end();
    });
    return putTogether(left);
  };
  EXPECT_TRUE(decode(without({}), "a.sweep"));
  expectRefused(without({"TNAM"}), "the targets have no names");
  expectRefused(without({"MOVE"}), "the targets' vectors are missing");
  expectRefused(without({"TNAM", "MOVE", "drif"}), "targets are missing");
  expectRefused(without({"loos", "drif"}), "the loose vertices are missing");
}

TEST(Damage, WhatIsNotAnnouncedMustNotFollow) {
  const std::string bytes = encode(makeRig(onePatch(1, 1)));  // with three targets
  const std::string ofAFourth = payloadOf([](codec::Writer& out) { out.number(4); });
  expectRefused(withPayload(bytes, "EXAC", ofAFourth), "there are more poses than announced");
  auto chunks = takeApart(bytes);
  const auto isLater = [](const FileChunk& chunk) {
    return codec::rankOf(chunk.code) > codec::rankOf("drif");
  };
  chunks.insert(std::ranges::find_if(chunks, isLater), {"drif", std::string(3, '\0')});
  expectRefused(putTogether(chunks), "there are no loose vertices that could move");
}

TEST(Damage, TargetsMustHaveNamesAndDifferentOnes) {
  Rig rig = makeRig(onePatch(1, 1));
  for (const char* name :
       {"", "\xFF", "\xC3", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "a\nb"}) {
    rig.targets[0].name = name;
    expectRefused(encodeVersion1(rig), "the target's name is empty or not UTF-8");
  }
  rig.targets[0].name = "rest";
  expectRefused(encodeVersion1(rig), "there are two targets named 'rest'");
}

TEST(Damage, WhatIsNotFiniteIsRefused) {
  Rig rig = dressed(makeRig(onePatch(1, 1)));
  rig.neutral[2].y = std::nan("");
  expectRefused(encodeVersion1(rig), "chunk 'NEUT'");
  rig = dressed(makeRig(onePatch(1, 1)));
  rig.source.loose[0].x = 1.0 / 0.0;
  expectRefused(encodeVersion1(rig), "chunk 'loos'");
  rig = makeRig(onePatch(1, 1));
  rig.tolerance = -1;
  expectRefused(encodeVersion1(rig), "the tolerance is negative");
}

TEST(Damage, ToleranceAndStepsMustNotBeNegative) {
  const std::string bytes = encode(makeRig(onePatch(1, 1)));
  for (int wrong = 0; wrong < 3; ++wrong) {
    const std::string base = payloadOf([&](codec::Writer& out) {
      for (int k = 0; k < 3; ++k) out.f64(k == wrong ? -1 : 1);
      out.number(3), out.number(0);
    });
    expectRefused(withPayload(bytes, "BASE", base),
                  wrong == 0 ? "the tolerance is negative" : "a step is negative");
  }
}

TEST(Damage, NamesMustBeTextsAndOneForEachThing) {
  const auto named = [](const Names& names) {
    Rig rig = makeRig(onePatch(1, 1));
    rig.names = names;
    return encode(rig);
  };
  EXPECT_TRUE(decode(named({"cm", {"a", "b", "", ""}, {}, {}, {}}), "a.sweep"));
  expectRefused(named({"\xFF", {}, {}, {}, {}}), "the units are not UTF-8");
  expectRefused(named({"", {"a", "\xFF", "", ""}, {}, {}, {}}), "a name is not UTF-8");
  expectRefused(named({"", {"a", "b", "c"}, {}, {}, {}}), "there are too many or too few names");
}

TEST(Damage, BlocksMustBeOfAKnownFormAndEndWhereTheyEnd) {
  const std::string bytes = encodeVersion1(dressed(makeRig(onePatch(1, 1))));
  const auto loose = [&](const std::string& block) { return withPayload(bytes, "loos", block); };
  EXPECT_TRUE(decode(loose({1, 0}), "a.sweep"));  // two zero vectors, as a mask
  expectRefused(loose({1, 4}), "a mask has bits beyond its end");
  expectRefused(loose('\x8' + std::string(24, '\0')),
                "vectors are held in a form this program does not know");
  const std::string emptyRun =
      payloadOf([](codec::Writer& out) { out.number(1), out.signedNumber(4), out.number(0); });
  expectRefused(withPayload(bytes, "poly", emptyRun), "a run has a wrong length");
}

TEST(Damage, QuadsMustGoAroundFacesOfFourCorners) {
  Rig rig = makeRig(onePatch(1, 1));
  const auto around = [&](std::int64_t corner) {
    return withPayload(encodeVersion1(rig), "quad",
                       payloadOf([&](codec::Writer& out) { out.signedNumber(2 * corner); }));
  };
  EXPECT_TRUE(decode(around(0), "a.sweep"));
  expectRefused(around(4), "a corner is out of range");
  rig.source.polygons.faceStart = {0, 3};
  rig.source.polygons.corners = {0, 1, 2};
  rig.source.quadCorners = {0, 1, 2, 2};
  expectRefused(around(0), "a quad goes around a face that has not four corners");
}

TEST(Damage, IndicesOutOfRangeAreRefused) {
  const Rig good = dressed(makeRig(onePatch(2, 2)));
  const auto expectOutOfRange = [&](std::string_view code, auto change) {
    Rig rig = good;
    change(rig.source);
    expectRefused(encodeVersion1(rig), "chunk '" + std::string(code) + "'");
  };
  expectOutOfRange("ordr", [](SourceMesh& s) { s.gridVertex[0] = 9; });
  expectOutOfRange("ordr", [](SourceMesh& s) { s.gridVertex[0] = -3; });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.corners[3] = 11; });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.corners[3] = -1; });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.faceMaterial[0] = 2; });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.faceGroup[1] = -2; });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.faceGroup.pop_back(); });
  expectOutOfRange("poly", [](SourceMesh& s) { s.polygons.faceStart[1] = 2; });
  expectOutOfRange("texc", [](SourceMesh& s) { s.polygons.cornerTexcoords[0] = 16; });
  expectOutOfRange("texc", [](SourceMesh& s) { s.polygons.cornerTexcoords[0] = -2; });
  expectOutOfRange("texc", [](SourceMesh& s) { s.polygons.cornerTexcoords.pop_back(); });
  expectOutOfRange("quad", [](SourceMesh& s) { s.quadCorners[5] = 16; });
  expectOutOfRange("quad", [](SourceMesh& s) { s.quadCorners.resize(12); });
  expectOutOfRange("quad", [](SourceMesh& s) { s.quadCorners.resize(20); });
}

}  // namespace
}  // namespace sweepface
