#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "codec/rigs.hpp"
#include "mesh/grid_source.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(RoundTrip, GivesTheSameRig) {
  for (const Rig& rig : someRigs()) {
    const auto back = decode(encode(rig), "a.sweep");
    ASSERT_TRUE(back) << back.error().message;
    expectEqual(*back, rig);
  }
}

TEST(RoundTrip, GivesTheSameBytes) {
  for (const Rig& rig : someRigs()) {
    const std::string bytes = encode(rig);
    EXPECT_EQ(encode(decode(bytes, "a.sweep").value()), bytes);
  }
}

TEST(RoundTrip, GivesTheSamePoints) {
  for (const Rig& rig : someRigs()) {
    const Rig back = decode(encode(rig), "a.sweep").value();
    const Weights weights{1, 0.5, -2};
    EXPECT_EQ(Tessellation(back.surface, 3).positions(blend(back, weights)),
              Tessellation(rig.surface, 3).positions(blend(rig, weights)));
    EXPECT_EQ(blendLoose(back, weights), blendLoose(rig, weights));
  }
}

/// Hair is made of such cards. They are so alike that they take hardly any bytes.
TEST(RoundTrip, KeepsThousandsOfSeparateCards) {
  constexpr Index kCards = 6000;
  const Wireframe card = onePatch(1, 1);
  Wireframe cards;
  cards.points = kCards * card.points;
  cards.ribbons = card.ribbons;
  for (Index k = 0; k < kCards; ++k) {
    for (Node node : card.nodes) cards.nodes.push_back({node.point + 4 * k, kPosition});
    for (Arc arc : card.arcs) {
      arc.from += 4 * k, arc.to += 4 * k;
      cards.arcs.push_back(arc);
    }
    Patch patch = card.patches[0];
    for (Index& side : patch.sides) side += 4 * k;
    cards.patches.push_back(patch);
    for (const HalfArc half : card.loops) cards.loops.push_back(half + 8 * k);
  }
  const Rig rig = makeRig(std::move(cards));
  const std::string bytes = encode(rig);
  const auto again = decode(bytes, "cards");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(*again), bytes);
}

TEST(RoundTrip, KeepsARigWithoutSourceOrTargets) {
  Rig rig = makeRig(onePatch(2, 2));
  rig.source = {};
  rig.targets.clear();
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

// This is more than a reader expects from so few bytes.
TEST(RoundTrip, KeepsASourceOfMuchThatIsAlike) {
  constexpr std::size_t kMany = 1'200'000;
  Rig many = makeRig(onePatch(1, 1)), textured = many;
  many.source.loose.resize(kMany);
  for (Target& target : many.targets) target.looseDifference.resize(kMany);
  for (std::size_t k = 0; k < kMany; ++k)
    many.source.gridVertex.push_back(-1 - static_cast<Index>(k));
  textured.source.polygons.texcoords.resize(kMany);
  textured.packing.textureBits = 14;
  for (const Rig& rig : {many, textured}) {
    const auto back = decode(encode(rig), "a.sweep");
    ASSERT_TRUE(back) << back.error().message;
    expectEqual(*back, rig);
  }
}

// A regular sheet takes next to no bytes, however large it is.
TEST(RoundTrip, KeepsThatALargeSheetHasNoOrderOfItsOwn) {
  Rig rig = makeRig(onePatch(800, 800));
  rig.source = gridSource(rig.surface);
  rig.source.ownOrder = false;
  const std::string bytes = encode(rig);
  EXPECT_LT(bytes.size(), 2000u);
  const auto back = decode(bytes, "a.sweep");
  ASSERT_TRUE(back) << back.error().message;
  expectEqual(*back, rig);
  EXPECT_FALSE(back->source.ownOrder);
}

TEST(RoundTrip, WritesTargetsThatSayNothingOfLooseVerticesAsIfTheyLeftThem) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.source.loose = {{1, 2, 3}, {4, 5, 6}};
  for (Target& target : rig.targets) target.looseDifference.assign(2, {0, 1, 0});
  rig.targets[1].looseDifference.clear();
  const auto back = decode(encode(rig), "a.sweep");
  ASSERT_TRUE(back) << back.error().message;
  rig.targets[1].looseDifference.assign(2, {});
  expectEqual(*back, rig);
}

TEST(RoundTrip, KeepsMaterialsOfASourceWithoutVertices) {
  Rig rig = makeRig(onePatch(2, 1));
  rig.source = {};
  rig.source.polygons.materials = {"skin"};
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

// The grid's coder cannot hold such faces; reading the file fails.
TEST(RoundTrip, IsRefusedOfFacesOfTwoCorners) {
  Rig rig = makeRig(onePatch(2, 1));
  rig.source.polygons.faceStart = {0, 4, 6, 8};
  rig.source.polygons.corners = {0, 1, 2, 3, 4, 5, 1, 2};
  rig.source.quadCorners.clear();
  EXPECT_FALSE(decode(encode(rig), "a.sweep"));
}

TEST(RoundTrip, KeepsFacesThatAreNotQuadsAndQuadsThatAreNotFaces) {
  Rig rig = makeRig(onePatch(2, 1));
  Polygons& faces = rig.source.polygons;
  faces.faceStart = {0, 3, 8};
  faces.corners = {0, 1, 2, 3, 4, 5, 1, 2};
  rig.source.quadCorners = {2, 1, 1, 0, 7, 6, 3, 4};
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

TEST(RoundTrip, KeepsVectorsExactlyWhateverTheyAre) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.neutral[0] = {0.1, 1e38, -1e-300};
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

TEST(RoundTrip, KeepsTheSignOfZero) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.targets[2].difference[3] = {0, -0.0, 0};
  rig.source.loose.resize(3);
  rig.targets[0].looseDifference = {{}, {0, -0.0, 0}, {1.0 / 3, 0, 0}};
  const Rig back = decode(encode(rig), "a.sweep").value();
  EXPECT_TRUE(std::signbit(back.targets[2].difference[3].y));
  EXPECT_TRUE(std::signbit(back.targets[0].looseDifference[1].y));
}

TEST(RoundTrip, KeepsTextureCoordinatesAndLooseVerticesInDoublePrecision) {
  Rig rig = dressed(makeRig(onePatch(1, 1)));
  rig.source.polygons.texcoords[1] = {1.0 / 3, 1e-300};
  rig.source.loose[1] = {1.0 / 7, 1e38, 0};
  rig.targets[0].looseDifference[0] = {1.0 / 9, 0, 0};
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

TEST(RoundTrip, KeepsTextureCoordinatesThatAreTooFarAwayForSteps) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.packing.textureBits = 12;
  for (const Vec2 far : {Vec2{1 << 20, 0}, Vec2{0, 1 << 20}}) {
    rig.source.polygons.texcoords = {far};
    expectEqual(decode(encode(rig), "a.sweep").value(), rig);
  }
}

TEST(RoundTrip, KeepsDecimalsOfATextExactlyAndInFewBytes) {
  Rig rig = makeRig(onePatch(1, 1));
  auto& texcoords = rig.source.polygons.texcoords;
  for (int k = 0; k < 1000; ++k)
    texcoords.push_back({std::stod("0." + std::to_string(100000 + 37 * k)), -k / 1e4});
  const std::string bytes = encode(rig);
  expectEqual(decode(bytes, "a.sweep").value(), rig);
  rig.source.polygons.texcoords.clear();
  EXPECT_LE(bytes.size() - encode(rig).size(), 4 * 1000u);
}

TEST(RoundTrip, KeepsNumbersThatAreNearlyDecimals) {
  Rig rig = makeRig(onePatch(1, 1));
  for (const Vec2 t : {Vec2{0.1, std::nextafter(0.2, 1)}, Vec2{0.1, -0.0}, Vec2{0.1, 1e16},
                       Vec2{1e-12, 9e3}, Vec2{0.123456789012, 8'999.5}, Vec2{1e-13, 1}}) {
    rig.source.polygons.texcoords = {t};
    const Rig back = decode(encode(rig), "a.sweep").value();
    EXPECT_EQ(back.source.polygons.texcoords[0], t);
    EXPECT_EQ(std::signbit(back.source.polygons.texcoords[0].y), std::signbit(t.y));
  }
}

}  // namespace
}  // namespace sweepface
