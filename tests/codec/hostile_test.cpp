#include <gtest/gtest.h>

#include "allocations.hpp"
#include "codec/bones.hpp"
#include "codec/coefficients.hpp"
#include "codec/encoding.hpp"
#include "codec/files.hpp"
#include "codec/lattice.hpp"
#include "codec/name_coder.hpp"
#include "codec/packed.hpp"
#include "codec/pose_form.hpp"
#include "codec/rigs.hpp"
#include "codec/version1.hpp"
#include "codec/wireframe_coder.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

constexpr std::uint64_t kTooMany = std::uint64_t{1} << 31;

// Replaces the first payload with this code by what `before` writes and a count of `kTooMany`.
void expectRefusedInLittleMemory(const std::string& bytes, std::string_view code, auto before) {
  const std::string changed = withPayload(bytes, code, payloadOf([&](codec::Writer& out) {
                                            before(out);
                                            out.number(kTooMany);
                                            out.raw("some more");
                                          }));
  allocations.largest = 0;
  const auto rig = decode(changed, "a.sweep");
  EXPECT_FALSE(rig) << code;
  EXPECT_LT(allocations.largest, 100'000u) << code;
}

TEST(Hostile, CountsAreRefusedBeforeRoomIsMadeForThem) {
  const std::string bytes = encodeVersion1(dressed(makeRig(onePatch(1, 1))));
  const auto nothing = [](codec::Writer&) {};
  for (const char* code : {"WIRE", "SHAP", "TARG", "ordr", "poly", "texc", "quad"})
    expectRefusedInLittleMemory(bytes, code, nothing);
  expectRefusedInLittleMemory(bytes, "WIRE", [](codec::Writer& out) { out.number(4); });
  expectRefusedInLittleMemory(bytes, "poly",
                              [](codec::Writer& out) { out.number(1), out.number(8); });
  expectRefusedInLittleMemory(bytes, "poly", [](codec::Writer& out) { out.number(1); });
  expectRefusedInLittleMemory(bytes, "poly", [](codec::Writer& out) {
    out.number(1), out.signedNumber(1'000'000), out.number(1);
  });
  for (int skipped = 0; skipped < 3; ++skipped)
    expectRefusedInLittleMemory(bytes, "HEAD", [&](codec::Writer& out) {
      out.f64(1);
      for (int k = 0; k < skipped; ++k) out.number(36);
    });
}

TEST(Hostile, LengthsOfChunksBeyondTheFileAreRefused) {
  std::string bytes = encodeVersion1(makeRig(onePatch(1, 1)));
  for (int k = 12; k < 16; ++k) bytes[k] = '\xFF';
  allocations.largest = 0;
  EXPECT_FALSE(decode(bytes, "a.sweep"));
  EXPECT_LT(allocations.largest, 10'000u);
}

// About the smallest memory limit under which a file is read.
std::size_t memoryFor(const std::string& bytes) {
  std::size_t little = 1, enough = std::size_t{1} << 32;
  while (enough > little + little / 16) {
    const std::size_t middle = (little + enough) / 2;
    (decode(bytes, "a.sweep", {middle}) ? enough : little) = middle;
  }
  return enough;
}

// Many targets that move none of many loose vertices: hardly a byte each.
Rig withManyStillTargets() {
  Rig rig = makeRig(onePatch(1, 1));
  rig.source.loose.resize(3000);
  const Target still{"", std::vector<Vec3>(rig.neutral.size()), std::vector<Vec3>(3000)};
  rig.targets.assign(200, still);
  for (std::size_t k = 0; k < rig.targets.size(); ++k) rig.targets[k].name = std::to_string(k);
  return packed(rig);
}

TEST(Hostile, WhatIsReadTakesNoMoreMemoryThanItIsAllowed) {
  constexpr std::size_t kAnyway = 1 << 20;  // tables that do not grow with the file
  for (const Rig& rig : {packed(makeRig(fan(5))), packed(everything()), dressed(makeRig(tee())),
                         withManyStillTargets()}) {
    for (const std::string& bytes : {encode(rig), encodeVersion1(rig)}) {
      const std::size_t limit = memoryFor(bytes);
      allocations.most = allocations.held;
      const std::size_t before = allocations.held;
      EXPECT_TRUE(decode(bytes, "a.sweep", {limit}));
      EXPECT_LT(allocations.most - before, limit + kAnyway);
      const auto refused = decode(bytes, "a.sweep", {limit / 2});
      ASSERT_FALSE(refused);
      EXPECT_NE(refused.error().message.find("memory"), std::string::npos)
          << refused.error().message;
    }
  }
}

// Poses are read one by one; what reading one takes is freed before the next.
TEST(Hostile, ManyTargetsAsTheyAreTakeLittleMoreThanTheirRig) {
  Rig rig = makeRig(sheet(8));
  Target exact{"", rig.neutral, rig.source.loose};
  for (Vec3& v : exact.difference) v = (1 / 3.0) * v;
  rig.targets.assign(200, exact);
  for (std::size_t k = 0; k < rig.targets.size(); ++k) rig.targets[k].name = std::to_string(k);
  const std::size_t vectors = rig.targets.size() * rig.neutral.size() * sizeof(Vec3);
  EXPECT_LT(memoryFor(encode(rig)), 2 * vectors + (1 << 20));
}

TEST(Hostile, VectorsThatWeightsTakeBeyondAFloatAreRefused) {
  Rig rig = packed(makeRig(sheet(4)));
  const auto scaled = [&](double size) {
    Rig large = rig;
    large.packing.neutralStep *= size, large.packing.targetStep *= size;
    for (Vec3& v : large.neutral) v = size * v;
    for (Target& target : large.targets)
      for (Vec3& v : target.difference) v = size * v;
    return decode(encode(large), "a.sweep");
  };
  EXPECT_TRUE(scaled(std::ldexp(1, 60)));
  const auto refused = scaled(std::ldexp(1, 90));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("too large"), std::string::npos);
}

// The payload that announces these numbers of targets and loose vertices.
std::string baseOf(std::size_t targets, std::size_t loose = 0) {
  return payloadOf([&](codec::Writer& out) {
    for (int k = 0; k < 3; ++k) out.f64(1);
    out.number(targets);
    out.number(loose);
  });
}

TEST(Hostile, LooseVerticesAreNoMoreThanTheFileCanHold) {
  const std::string bytes =
      withPayload(encode(makeRig(onePatch(1, 1))), "BASE", baseOf(3, 10'000'000));
  allocations.largest = 0;
  EXPECT_FALSE(decode(bytes, "a.sweep"));
  EXPECT_LT(allocations.largest, 1'000'000u);
}

// Zeros take a bit each, letters of a scene and empty names a byte each, turns 13 bytes.
TEST(Hostile, ChunksThatHoldThingsAsTheyAreTakeNoMoreMemoryThanAllowed) {
  constexpr std::size_t kLimit = 4 << 20, kSome = 8'000'000;
  Rig rig = withScene(dressed(makeRig(onePatch(1, 1))));
  rig.names.units = "cm";
  rig.turns = {{0, {}, {}}};
  const std::string bytes = encode(rig);
  const auto expectTooMuch = [&](const char* code, auto write) {
    const std::string changed = withPayload(bytes, code, payloadOf(write));
    allocations.most = allocations.held;
    const std::size_t before = allocations.held;
    const auto refused = decode(changed, "a.sweep", {kLimit});
    ASSERT_FALSE(refused) << code;
    EXPECT_NE(refused.error().message.find("memory"), std::string::npos) << refused.error().message;
    EXPECT_LT(allocations.most - before, kLimit) << code;
  };
  expectTooMuch("texc", [](codec::Writer& out) {
    out.number(kSome);
    out.byte(1);
    out.raw(std::string(kSome / 8, '\0'));
    out.number(0);
  });
  expectTooMuch("scen", [](codec::Writer& out) { out.text(std::string(kSome, ' ')); });
  expectTooMuch("name", [](codec::Writer& out) {
    out.text("");
    out.number(kSome);
    out.raw(std::string(kSome, '\0'));
  });
  expectTooMuch("turn", [](codec::Writer& out) {
    out.number(kSome / 14);
    for (std::size_t k = 0; k < kSome / 14; ++k) out.number(1), out.raw(std::string(12, '\0'));
  });
}

// A face has at least three corners: files store the size minus 3, which wraps for smaller sizes.
TEST(Hostile, FacesOfTwoCornersAreRefused) {
  const std::string bytes = encode(packed(everything()));
  for (const std::uint32_t size : {0u, 1u, 2u}) {
    const std::string payload = codec::ranged([&](auto& out) {
      out.number(0, 1, 0, 1);
      out.bit(37, 0, 0, true);
      out.bit(36, 0, 0, false);
      out.bit(11, 1, 0, false);
      out.number(15, 0, 0, size - 3);
      for (std::uint32_t k = 0; k < size; ++k) out.signedNumber(17, k, 0, 0);
    });
    const auto refused =
        decode(withPayload(bytes, "face", payload + std::string(50, 'U')), "a.sweep");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("too many corners"), std::string::npos)
        << refused.error().message;
  }
}

TEST(Hostile, CornersAndNamesOfFacesThatThereAreNotAreRefused) {
  const std::string bytes = encode(packed(everything()));
  const auto problemOf = [&](auto write) {
    const std::string payload = codec::ranged(write) + std::string(50, 'U');
    return decode(withPayload(bytes, "face", payload), "a.sweep").error().message;
  };
  const auto begin = [](auto& out, std::uint32_t faces, bool hasQuads) {
    out.number(0, 1, 0, faces);
    out.bit(37, 0, 0, true);
    out.bit(36, 0, 0, hasQuads);
  };
  const std::string quad = problemOf([&](auto& out) {
    begin(out, 0, true);
    for (std::uint32_t k = 0; k < 8 * 4; ++k) out.signedNumber(19, k % 4, 0, 0);
  });
  EXPECT_NE(quad.find("a corner is out of range"), std::string::npos) << quad;
  const std::string name = problemOf([&](auto& out) {
    begin(out, 1, false);
    out.bit(11, 1, 0, false);
    out.number(15, 0, 0, 0);
    for (std::uint32_t k = 0; k < 3; ++k) out.signedNumber(17, k, 0, 0);
    out.number(0, 2, 0, 1);  // one material, with an empty name
    out.number(0, 3, 0, 0);
    out.bit(21, 8, 0, true);
    out.bit(21, 0, 0, false);
    out.signedNumber(22, 0, 0, 2);
  });
  EXPECT_NE(name.find("the name of a face is out of range"), std::string::npos) << name;
}

// What bones carry takes memory and time, but hardly any bytes if it is always the same.
TEST(Hostile, WhatBonesCarryInAFewBytesIsRefused) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.targets.assign(1, {"a", std::vector<Vec3>(rig.neutral.size()), {}});
  rig = packed(std::move(rig));
  const codec::Lattice lattice(rig.surface, rig.packing);
  const auto moves = [&](std::size_t targets, std::int32_t large) {
    codec::RangeEncoder coder;
    codec::Symbols<codec::RangeEncoder> out(coder);
    std::vector<Index> hangs(rig.neutral.size(), 0);
    hangs[0] = codec::kMostBones - 1;
    codec::CoefficientCoder<codec::RangeEncoder> vectors(lattice.hierarchy(), coder, lattice.axis(),
                                                         false);
    const Index bones = codec::codeBones(out, lattice.hierarchy(), hangs);
    std::vector<Packing::Carry> carries;
    for (Index b = 0; b < codec::kMostBones; ++b) {
      carries.push_back({b, {}});
      for (auto& by : carries.back().by) by.fill(large);
    }
    for (Index k = 1; k <= static_cast<Index>(targets); ++k) {
      Packing::Pose form;
      codec::Likeness like;
      codec::codePose(out, form, k);
      codec::codeLikeness(out, form, like, k);
      codec::codeCarries(out, bones, carries);
      codec::Coefficients none(rig.neutral.size());
      vectors.code(none, codec::Symmetry::none, {}, {});
    }
    return coder.finish();
  };
  TakenApart chunks = takeApart(encode(rig));
  const auto expectRefused = [&](std::size_t targets, std::int32_t large, std::size_t limit,
                                 const char* why) {
    chunkOf(chunks, "BASE").payload = baseOf(targets);
    chunkOf(chunks, "TNAM").payload = codec::ranged([&](auto& out) {
      codec::NameCoder names(out);
      for (std::size_t k = 0; k < targets; ++k) names.code(std::to_string(k));
    });
    chunkOf(chunks, "MOVE").payload = moves(targets, large);
    const std::string bytes = putTogether(chunks);
    EXPECT_LT(bytes.size(), 60'000u);
    allocations.most = allocations.held;
    const std::size_t before = allocations.held;
    const auto refused = decode(bytes, "a.sweep", {limit});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(why), std::string::npos) << refused.error().message;
    EXPECT_LT(allocations.most - before, limit);
  };
  expectRefused(6000, 0, std::size_t{32} << 20, "memory");
  expectRefused(1000, (1 << 26) - 1, std::size_t{1} << 30, "too large for so few bytes");
}

// Long names that are all alike take hardly any bytes.
TEST(Hostile, LongNamesInAFewBytesAreRefused) {
  constexpr std::size_t kTargets = 1000;
  TakenApart chunks = takeApart(encode(makeRig(onePatch(1, 1))));
  chunkOf(chunks, "BASE").payload = baseOf(kTargets);
  const auto decoded = [&](std::size_t letters) {
    chunkOf(chunks, "TNAM").payload = codec::ranged([&](auto& out) {
      codec::NameCoder names(out);
      for (std::size_t k = 0; k < kTargets; ++k)
        names.code(std::string(letters, 'a') + std::to_string(k));
    });
    return decode(putTogether(chunks), "a.sweep").error().message;
  };
  EXPECT_NE(decoded(4000).find("names are too long"), std::string::npos) << decoded(4000);
  EXPECT_EQ(decoded(400).find("names are too long"), std::string::npos) << decoded(400);
}

// Names that are all alike take hardly any bytes.
TEST(Hostile, ManyNamesInAFewBytesAreRefused) {
  constexpr std::size_t kLimit = 16 << 20, kNames = 4'000'000;
  const std::string payload = codec::ranged([](auto& out) {
    out.number(0, 1, 0, 0);  // no faces beyond the grid's
    out.bit(37, 0, 0, true);
    out.bit(36, 0, 0, false);
    out.number(0, 2, 0, kNames);  // materials
    for (std::size_t k = 0; k < kNames; ++k) out.number(0, 3, 0, 0);
  });
  const std::string bytes =
      withPayload(encode(packed(everything())), "face", payload + std::string(5000, 'U'));
  allocations.most = allocations.held;
  const std::size_t before = allocations.held;
  EXPECT_FALSE(decode(bytes, "a.sweep", {kLimit}));
  EXPECT_LT(allocations.most - before, kLimit);
}

// Large coefficients that are all alike take hardly any bytes, but as long to read as others.
TEST(Hostile, LargeNumbersInAFewBytesAreRefused) {
  constexpr std::int32_t kLarge = (1 << 26) - 1;
  Rig rig = makeRig(sheet(8));
  rig.targets.clear();
  rig = packed(std::move(rig));
  rig.packing.targetStep = 1e-9;
  codec::Lattice lattice(rig.surface, rig.packing);
  lattice.learn(rig.surface, rig.neutral, rig.packing.neutralStep);
  Target target{"", std::vector<Vec3>(rig.neutral.size()), rig.source.loose};
  lattice.restore(1, codec::Coefficients(rig.neutral.size(), {kLarge, kLarge, kLarge}),
                  rig.packing.targetStep, target.difference);
  for (std::size_t k = 0; k < 200'000 / rig.neutral.size(); ++k) {
    target.name = std::to_string(k);
    rig.targets.push_back(target);
  }
  const std::string bytes = encode(rig);
  EXPECT_LT(bytes.size(), 20'000u);
  const auto refused = decode(bytes, "a.sweep");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("too large for so few bytes"), std::string::npos)
      << refused.error().message;
}

TEST(Hostile, NumbersMustBeShortAndSmall) {
  const std::string bytes = encodeVersion1(makeRig(onePatch(1, 1)));
  const auto message = [&](std::string_view number) {
    return decode(withPayload(bytes, "ordr", std::string(number)), "a.sweep").error().message;
  };
  EXPECT_NE(message({"\x80\0", 2}).find("shortest form"), std::string::npos);
  EXPECT_NE(message(std::string(20, '\xFF')).find("too large"), std::string::npos);
}

TEST(Hostile, WhatSaysTheSameTwiceIsRefused) {
  const Rig rig = packed(dressed(makeRig(sheet(3))));
  const std::string bytes = encode(rig), asItIs = encodeVersion1(rig);
  for (const auto& [code, other] :
       {std::pair{"ordr", "walk"}, {"poly", "face"}, {"texc", "text"}, {"quad", "face"}}) {
    TakenApart chunks = takeApart(bytes), plain = takeApart(asItIs);
    const FileChunk twin = chunkOf(plain, code);
    const auto isLater = [&](const FileChunk& chunk) {
      return codec::rankOf(chunk.code) > codec::rankOf(twin.code);
    };
    chunks.insert(std::ranges::find_if(chunks, isLater), twin);
    const auto read = decode(putTogether(chunks), "a.sweep");
    ASSERT_FALSE(read) << code;
    const std::string expected = std::string("must not stand beside chunk '") + other;
    EXPECT_NE(read.error().message.find(expected), std::string::npos) << read.error().message;
  }
}

std::string refusalOf(Wireframe wireframe) {
  Rig rig;
  Connectivity connectivity = Connectivity::make(wireframe).value();
  rig.surface = Surface::make(std::move(wireframe), std::move(connectivity)).value();
  rig.neutral.resize(rig.surface.storedCount());
  const auto back = decode(encodeVersion1(rig), "a.sweep");
  return back ? "" : back.error().message;
}

TEST(Hostile, DecimalsMustStayExact) {
  const std::string bytes = encodeVersion1(dressed(makeRig(onePatch(1, 1))));
  const auto decimals = [&](unsigned digits, std::int64_t value) {
    const auto payload = payloadOf([&](codec::Writer& out) {
      out.number(1), out.byte(4), out.byte(digits);
      out.signedNumber(value), out.signedNumber(0), out.byte(0);
    });
    return decode(withPayload(bytes, "texc", payload), "a.sweep");
  };
  EXPECT_TRUE(decimals(12, 8'999'999'999'999'999));
  EXPECT_FALSE(decimals(13, 1));
  EXPECT_FALSE(decimals(12, 9'000'000'000'000'000));
  EXPECT_FALSE(decimals(12, -9'000'000'000'000'000));
}

TEST(Hostile, PatchesMustNotHaveTooManyVertices) {
  EXPECT_EQ(refusalOf(onePatch(65535, 970)), "");
  EXPECT_NE(refusalOf(onePatch(65535, 980)).find("too many vertices"), std::string::npos);
  EXPECT_NE(refusalOf(onePatch(65536, 1)).find("length of an arc"), std::string::npos);
}

TEST(Hostile, WireframesThatCannotBeEvaluatedAreRefused) {
  Wireframe unused = onePatch(1, 1);
  unused.arcs.push_back(unused.arcs[0]);
  EXPECT_NE(refusalOf(unused).find("an arc bounds no patch"), std::string::npos);

  // Collapses an arc between two inner nodes, which other patches surround as well.
  Wireframe torn = sheet(4);
  const auto isInside = [&](const Arc& a) {
    const Connectivity c = Connectivity::make(torn).value();
    return c.stars[a.from].closed && c.stars[a.to].closed;
  };
  std::ranges::find_if(torn.arcs, isInside)->collapsed = true;
  EXPECT_NE(refusalOf(torn).find("a collapsed arc joins two points"), std::string::npos);

  Wireframe gap = onePatch(1, 1);
  gap.nodes[0].stored = 1 | 1 << 2;
  EXPECT_NE(refusalOf(gap).find("without those before it"), std::string::npos);
}

TEST(Hostile, WhatTheSurfaceRefusesIsPassedOn) {
  auto chunks = takeApart(encodeVersion1(makeRig(onePatch(1, 1))));
  // The last byte is the difference between two successive half-arcs.
  std::string& wire = chunkOf(chunks, "WIRE").payload;
  wire.back() = 4;
  const auto rig = decode(putTogether(chunks), "a.sweep");
  ASSERT_FALSE(rig);
  EXPECT_NE(rig.error().message.find("the wireframe is unsound: patch 0 is not a closed loop"),
            std::string::npos)
      << rig.error().message;
}

// `patches` patches around one node, each joined to the one before.
Wireframe fanOf(Index patches) {
  Wireframe w;
  const auto node = [&] {
    return static_cast<Index>((w.nodes.push_back({w.points, kPosition}), w.points++));
  };
  const auto arc = [&](Index from, Index to) {
    w.arcs.push_back({from, to});
    return 2 * static_cast<HalfArc>(w.arcs.size() - 1);
  };
  const Index centre = node();
  Index rim = node();
  HalfArc spoke = arc(centre, rim);
  for (Index p = 0; p < patches; ++p) {
    const Index corner = node(), next = node();
    const HalfArc there = arc(rim, corner), on = arc(corner, next), back = arc(centre, next);
    const auto first = static_cast<Index>(w.loops.size());
    w.loops.insert(w.loops.end(), {spoke, there, on, twin(back)});
    w.patches.push_back({{first, first + 1, first + 2, first + 3, first + 4}});
    rim = next, spoke = back;
  }
  w.ribbons.emplace_back();
  return w;
}

TEST(Hostile, StepsMustNotBeTooFine) {
  for (const std::uint64_t finer : {std::uint64_t{41}, std::uint64_t{0xfffffffe}}) {
    codec::RangeEncoder encoder;
    codec::Symbols<codec::RangeEncoder> out(encoder);
    out.number(45, 0, 0, finer);
    const std::string bytes = encoder.finish();
    codec::RangeDecoder decoder(bytes);
    codec::Symbols<codec::RangeDecoder> in(decoder);
    Packing::Pose form;
    codec::codePose(in, form, 0);
    EXPECT_FALSE(in.ok()) << finer;
    EXPECT_EQ(form.finer, 0);
  }
}

std::string problemWith(const Wireframe& wireframe, const codec::MirrorSeeds& seeds = {}) {
  codec::RangeEncoder encoder;
  codec::Symbols<codec::RangeEncoder> out(encoder);
  codec::writeWireframe(out, wireframe, seeds);
  const std::string bytes = encoder.finish();
  codec::RangeDecoder decoder(bytes);
  codec::Symbols<codec::RangeDecoder> in(decoder);
  codec::readWireframe(in, std::size_t{1} << 20, std::int64_t{1} << 30);
  return in.ok() ? "" : std::string(in.problem());
}

TEST(Hostile, WireframesOfMoreThanTheyCanUseAreRefused) {
  const Wireframe good = onePatch(1, 1);
  const codec::MirrorSeeds mirror{0, {64, {0, 0}}}, tooMany{0, {65, {0, 0}}};
  EXPECT_EQ(problemWith(good, mirror), "");
  EXPECT_NE(problemWith(good, tooMany).find("begins in too many places"), std::string::npos);
  Wireframe wireframe = good;
  wireframe.points = 9;
  EXPECT_NE(problemWith(wireframe).find("more points than nodes"), std::string::npos);
  wireframe = good;
  wireframe.ribbons.resize(9);
  EXPECT_NE(problemWith(wireframe).find("more ribbons than arcs"), std::string::npos);
  wireframe = good;
  wireframe.ribbons[0].lambda = 1.0 / 0.0;
  EXPECT_NE(problemWith(wireframe).find("a value is not finite"), std::string::npos);
}

/// A patch whose first side is cut into this many arcs.
Wireframe combed(Index arcs) {
  Wireframe w = onePatch(arcs, 1);
  for (Index k = 1; k < arcs; ++k) w.nodes.push_back({w.points++, kPosition});
  w.arcs[0] = arc(0, 4, 1, 0);
  w.loops = {0};
  for (Index k = 1; k < arcs; ++k) {
    w.loops.push_back(static_cast<HalfArc>(2 * w.arcs.size()));
    w.arcs.push_back(arc(3 + k, k + 1 < arcs ? 4 + k : 1, 1, 0));
  }
  w.loops.insert(w.loops.end(), {2, 5, 6});
  w.patches = {{{0, arcs, arcs + 1, arcs + 2, arcs + 3}}};
  return w;
}

TEST(Hostile, PatchesOfMoreArcsThanOneLooksAlongAreRefused) {
  EXPECT_NE(problemWith(combed(4093)).find("is no T of three arcs"), std::string::npos);
  EXPECT_NE(problemWith(combed(4094)).find("too many arcs around it"), std::string::npos);
  const auto made = Surface::make(combed(4094));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "patch 0 has more than 4096 arcs around it; divide it");
}

// Ribbons that no patch has take an eighth of a byte each.
TEST(Hostile, RibbonsOfNoPatchTakeTheMemoryThatIsAllowed) {
  constexpr std::size_t kRibbons = 1 << 20;
  const std::string bytes = withPayload(encodeVersion1(makeRig(onePatch(1, 1))), "SHAP",
                                        payloadOf([](codec::Writer& out) {
                                          out.number(kRibbons);
                                          out.raw(std::string(kRibbons / 8, '\0'));
                                        }));
  EXPECT_TRUE(decode(bytes, "a.sweep"));
  allocations.largest = 0;
  const auto rig = decode(bytes, "a.sweep", {4'000'000});
  ASSERT_FALSE(rig);
  EXPECT_NE(rig.error().message.find("memory"), std::string::npos) << rig.error().message;
  EXPECT_LT(allocations.largest, 4'000'000u);
}

/// A sheet each of whose arcs along v has a shape of its own.
Wireframe sheetOfShapes(Index size) {
  Wireframe w = sheet(size);
  w.ribbons = {{}};
  for (std::size_t a = w.arcs.size() / 2; a < w.arcs.size(); ++a) {
    w.arcs[a].ribbon = static_cast<Index>(w.ribbons.size());
    w.ribbons.push_back({1, -1 - std::ldexp(static_cast<double>(a), -20), 0});
  }
  return w;
}

// Near a resonance each shape takes as long as thousands of patches.
TEST(Hostile, TooManyShapesAreRefused) {
  EXPECT_TRUE(Surface::make(sheetOfShapes(100)));
  const auto made = Surface::make(sheetOfShapes(130));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "the ribbons have more than 16384 pairs of a shape and a length");
}

TEST(Hostile, SentencesOfOthersEndWithTheAdvice) {
  Rig rig = makeRig(onePatch(1, 1));
  const std::string file = encode(rig);
  Wireframe resonant = onePatch(1, 1);
  resonant.ribbons[1] = {1, 80.7, 1};
  const auto refused = decode(withPayload(file, "GRID", codec::ranged([&](auto& out) {
                                            codec::writeWireframe(out, resonant, {});
                                          })),
                              "a.sweep");
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.ends_with("at most 10); convert the source again."))
      << refused.error().message;
}

// Sums of such would be infinite, and differences of those no numbers.
TEST(Hostile, ExactVectorsBeyondSinglePrecisionAreRefused) {
  Rig rig = makeRig(onePatch(2, 2));
  rig.neutral[0].x = 3e38;
  EXPECT_TRUE(decode(encode(rig), "far"));
  rig.neutral[0].x = 4e38;
  const auto refused = decode(encode(rig), "far");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("beyond single precision"), std::string::npos)
      << refused.error().message;
}

// A file of a few bytes could keep a reader busy for hours.
TEST(Hostile, WhatTakesTooLongToFollowIsRefused) {
  EXPECT_EQ(problemWith(fanOf(300)), "");
  EXPECT_NE(problemWith(fanOf(20'000)).find("in time"), std::string::npos);
}

}  // namespace
}  // namespace sweepface
