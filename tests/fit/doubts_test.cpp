#include "fit/doubts.hpp"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "sweepface/fit.hpp"

#include "faces.hpp"
#include "fit/coarseness.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A face with the given targets.
MeshRig rigWith(std::initializer_list<std::pair<const char*, std::vector<Vec3>>> targets) {
  MeshRig rig{plane(), {}};
  for (const auto& [name, positions] : targets) rig.targets.push_back({name, positions});
  return rig;
}
std::vector<Vec3> opened() { return withTargets(plane(), 1).targets[0].positions; }
std::vector<Vec3> scaled(double factor) {
  std::vector<Vec3> positions = plane().positions;
  for (Vec3& p : positions) p *= factor;
  return positions;
}
std::vector<Vec3> shuffled() {
  std::vector<Vec3> positions = opened();
  std::ranges::shuffle(positions, std::mt19937(3));
  return positions;
}

std::vector<Vec3> placed(const std::function<Vec3(const Vec3&)>& place) {
  std::vector<Vec3> positions = plane().positions;
  for (Vec3& p : positions) p = place(p);
  return positions;
}
/// The single warning about a face that has this target in addition to a good one.
std::string doubtAbout(const std::vector<Vec3>& positions) {
  const auto doubts = doubtsAbout(rigWith({{"open", opened()}, {"odd", positions}}), 0.01);
  EXPECT_EQ(doubts.size(), 1u);
  return doubts.empty() ? std::string() : doubts[0];
}

TEST(Doubts, AreNoneOfAFaceAsTheyAre) {
  const auto nodding =
      placed([](const Vec3& p) { return Vec3{p.x, 0.8 * p.y - 0.6 * p.z, 0.6 * p.y + 0.8 * p.z}; });
  EXPECT_TRUE(
      doubtsAbout(rigWith({{"open", opened()}, {"nod", nodding}, {"grow", scaled(1.5)}}), 0.01)
          .empty());
  EXPECT_TRUE(doubtsAbout(rigWith({}), 0.01).empty());
}

TEST(Doubts, AreOfTargetsInOtherUnits) {
  for (const auto& [factor, told] : {std::pair(2.54, "2.54"), {100, "100"}, {0.01, "0.01"}})
    EXPECT_EQ(doubtAbout(scaled(factor)),
              std::string("Targets that may be in other units, or have their vertices in another "
                          "order: 'odd' (edges ") +
                  told + " times as long).");
}

TEST(Doubts, AreOfTargetsInAnotherOrder) {
  EXPECT_TRUE(doubtAbout(shuffled()).starts_with("Targets that may be in other units, or have"));
  EXPECT_TRUE(doubtAbout(scaled(0)).ends_with("'odd' (edges 0 times as long)."));
}

TEST(Doubts, AreOfTargetsOfOtherAxes) {
  EXPECT_EQ(doubtAbout(placed([](const Vec3& p) { return Vec3{p.x, -p.z, p.y}; })),
            "Targets that may have other axes: 'odd' (turned by 90 degrees).");
  std::vector<Vec3> alsoOpen = opened();  // turned by slightly less than 90 degrees
  for (Vec3& p : alsoOpen) p = {p.x, 0.02 * p.y - p.z, p.y + 0.02 * p.z};
  EXPECT_EQ(doubtAbout(alsoOpen),
            "Targets that may have other axes: 'odd' (turned by 90 degrees).");
  MeshRig ball{cubeSphere(), {}};
  std::vector<Vec3> mirrored = ball.neutral.positions;
  for (Vec3& p : mirrored) p.x = -p.x;
  ball.targets.push_back({"odd", mirrored});
  EXPECT_EQ(doubtsAbout(ball, 0.01),
            std::vector<std::string>{"Targets that may have other axes: 'odd' (mirrored)."});
  // For a flat face, mirroring cannot be told from turning.
  MeshRig flat{grid(4, 4, [](double i, double j) { return Vec3{i - 2, 2 * j - 4, 0}; }), {}};
  flat.targets.push_back({"odd", flat.neutral.positions});
  for (Vec3& p : flat.targets[0].positions) p.x = -p.x;
  EXPECT_EQ(
      doubtsAbout(flat, 0.01),
      std::vector<std::string>{"Targets that may have other axes: 'odd' (turned by 180 degrees)."});
}

std::vector<Vec3> farAway() {
  return placed([](const Vec3& p) { return p + Vec3{50, 0, 0}; });
}

TEST(Doubts, AreOfMostTargetsOfAnotherOrigin) {
  EXPECT_EQ(doubtsAbout(rigWith({{"a", farAway()}, {"b", farAway()}, {"open", opened()}}), 0.01),
            std::vector<std::string>{
                "Targets that may have another origin: 'a' (50 away), 'b' (50 away)."});
  // Targets that do not move do not count.
  EXPECT_EQ(
      doubtsAbout(rigWith({{"a", farAway()}, {"b", plane().positions}, {"c", plane().positions}}),
                  0.01)
          .back(),
      "Targets that may have another origin: 'a' (50 away).");
  // The jaw takes the teeth with it.
  EXPECT_TRUE(doubtsAbout(rigWith({{"jaw", farAway()}, {"open", opened()}}), 0.01).empty());
}

TEST(Doubts, AreNoneOfTurningHeads) {
  const auto turned = placed([](const Vec3& p) {
    const double c = std::cos(1.2), s = std::sin(1.2);
    return Vec3{c * p.x + s * p.z, p.y, c * p.z - s * p.x};
  });
  EXPECT_TRUE(doubtsAbout(rigWith({{"turn", turned}}), 0.01).empty());
}

TEST(Doubts, AreOfTargetsThatAreTheNeutral) {
  MeshRig rig = rigWith({{"open", opened()}, {"rest", plane().positions}});
  // A vertex that no face uses does not count.
  rig.neutral.positions.push_back({});
  for (MeshTarget& target : rig.targets) target.positions.push_back({5, 5, 5});
  EXPECT_EQ(doubtsAbout(rig, 0.01),
            std::vector<std::string>{"Targets that are the same as the neutral: 'rest'."});
}

TEST(Doubts, AreOfTargetsThatAreCalledLikeANeutral) {
  for (const char* name : {"Neutral", "basis", "REST"}) {
    const auto doubts = doubtsAbout(rigWith({{"open", opened()}, {name, opened()}}), 0.01);
    ASSERT_EQ(doubts.size(), 1u) << name;
    EXPECT_NE(doubts[0].find(fmt::format("called like a neutral but are others: '{}';", name)),
              std::string::npos)
        << doubts[0];
  }
}

TEST(Doubts, NameSixTargetsAtMost) {
  MeshRig rig = rigWith({});
  for (int k = 0; k < 9; ++k)
    rig.targets.push_back({"t" + std::to_string(k), rig.neutral.positions});
  EXPECT_TRUE(doubtsAbout(rig, 0.01)[0].ends_with("'t4', 't5' and 3 more."));
}

TEST(Doubts, AreOfAToleranceLikeTheMesh) {
  const MeshRig rig = rigWith({});
  const double size = diagonal(rig.neutral);
  EXPECT_TRUE(doubtsAbout(rig, 0.049 * size).empty());
  const auto doubts = doubtsAbout(rig, 0.25 * size);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("is 25 % of the mesh's size"), std::string::npos) << doubts[0];
}

/// A ground plane next to a head makes the mesh look large.
TEST(Doubts, AreOfAToleranceFarAboveEdges) {
  MeshRig rig = rigWith({});
  const Index first = static_cast<Index>(rig.neutral.positions.size());
  for (const Vec3& p : {Vec3{-1e4, 0, -1e4}, {1e4, 0, -1e4}, {1e4, 0, 1e4}, {-1e4, 0, 1e4}})
    rig.neutral.positions.push_back(p);
  addFace(rig.neutral, {first, first + 1, first + 2, first + 3});
  EXPECT_EQ(doubtsAbout(rig, 0.0002 * diagonal(rig.neutral)).size(), 1u);
  // Edges of zero length do not count.
  for (Vec3& p : rig.neutral.positions)
    if (std::abs(p.x) < 100) p = {};
  EXPECT_TRUE(doubtsAbout(rig, 0.0002 * diagonal(rig.neutral)).empty());
}

/// A sheet of quads whose every other row of vertices is `height` above the others.
PolygonMesh corrugated(double height, Index size = 32) {
  return grid(size, size, [&](double i, double j) { return Vec3{i, j, std::fmod(j, 2) * height}; });
}

TEST(Doubts, AreOfAToleranceTooFineForACoarseMesh) {
  const double lean = std::atan(0.1) * 180 / std::numbers::pi;
  const Coarseness coarse = coarsenessOf(corrugated(0.1));
  EXPECT_NEAR(coarse.degrees, lean, 1e-9);
  EXPECT_NEAR(coarse.height, 0.1 / std::pow(1.01, 0.25), 1e-9);  // a face is a little longer than 1
  const MeshRig rig{corrugated(0.1), {}};
  const auto doubts = doubtsAbout(rig, 0.4);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("lean 5.7 degrees"), std::string::npos) << doubts[0];
  EXPECT_TRUE(doubts[0].ends_with("and try a tolerance of 0.5.")) << doubts[0];
  EXPECT_TRUE(doubtsAbout(rig, 0.5).empty());
  // No tolerance is proposed that would be doubted itself.
  const auto rough = doubtsAbout({corrugated(1), {}}, 0.4);
  ASSERT_EQ(rough.size(), 1u);
  EXPECT_TRUE(rough[0].ends_with("otherwise compare pictures.")) << rough[0];
  EXPECT_TRUE(doubtsAbout({corrugated(0.04), {}}, 0.01).empty());   // as good as smooth
  EXPECT_TRUE(doubtsAbout({corrugated(0.1, 4), {}}, 0.1).empty());  // too few faces to judge
}

TEST(Doubts, AreToldByConvert) {
  const MeshRig rig = rigWith({{"still", plane().positions}});
  const auto conversion = convert(rig);
  ASSERT_TRUE(conversion) << conversion.error().message;
  ASSERT_EQ(conversion->warnings.size(), 1u);
  EXPECT_NE(conversion->warnings[0].find("'still'"), std::string::npos);
}

}  // namespace
}  // namespace sweepface
