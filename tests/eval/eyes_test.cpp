#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "sweepface/arcs.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/head.hpp"
#include "sweepface/io.hpp"

#include "codec/rigs.hpp"
#include "eval/balls.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

constexpr double kRadius = 1.5;
const Vec3 kLeft{3, 4, -1}, kRight{-3, 4, -1};

/// Skin and two eyeballs, with a smaller ball inside the left one. eyeLookDown_L moves the skin
/// and, if `looks`, turns the left eyeball and the ball inside it by 0.4 radians.
MeshRig faceWithEyes(bool looks) {
  PolygonMesh mesh = plane();
  const auto skin = mesh.positions.size();
  mesh = joined(mesh, cubeSphere(6, kRadius), kLeft);
  const auto leftEnd = mesh.positions.size();
  mesh = joined(mesh, cubeSphere(6, kRadius), kRight);
  const auto rightEnd = mesh.positions.size();
  mesh = joined(mesh, cubeSphere(3, 0.8), kLeft + Vec3{0, 0, 0.2});
  MeshRig rig = withTargets(mesh, 1);
  std::vector<Vec3> looking = mesh.positions;
  const Quaternion by = quaternionOf({0, 0.4, 0});
  for (std::size_t v = skin; looks && v < looking.size(); ++v)
    if (v < leftEnd || v >= rightEnd) looking[v] = kLeft + turned(by, looking[v] - kLeft);
  for (std::size_t v = 0; v < skin; ++v) looking[v].z += 0.2 * std::sin(looking[v].x);
  rig.targets.push_back({"eyeLookDown_L", looking});
  return rig;
}

Rig converted(const MeshRig& mesh) {
  ConvertOptions options;
  options.tolerance = 0.005;
  return convert(mesh, options).value().rig;
}

/// The converted face with eyes.
const Rig& convertedFace(bool looks) {
  static std::map<bool, Rig> rigs;
  if (!rigs.contains(looks)) rigs.emplace(looks, converted(faceWithEyes(looks)));
  return rigs.at(looks);
}

std::vector<Vec3> shown(const Rig& rig, const std::vector<double>& weights) {
  return sourcePositions(rig, Tessellation(rig.surface, 1), blend(rig, weights), weights);
}

/// The largest change from rest in the distances between the vertices [first, last).
double stretch(const std::vector<Vec3>& rest, const std::vector<Vec3>& now, std::size_t first,
               std::size_t last, std::size_t step = 1) {
  double most = 0;
  for (std::size_t a = first; a < last; a += step)
    for (std::size_t b = a + step; b < last; b += step)
      most = std::max(most, std::abs(norm(rest[a] - rest[b]) - norm(now[a] - now[b])));
  return most;
}

const Eye* named(const std::vector<Eye>& eyes, std::string_view name) {
  const auto found = std::ranges::find(eyes, name, &Eye::name);
  return found == eyes.end() ? nullptr : &*found;
}

TEST(Eyes, AreTheTwoBallsAndWhatIsInThem) {
  const Rig& rig = convertedFace(false);
  const auto eyes = findEyes(rig);
  ASSERT_EQ(eyes.size(), 2u);
  const Eye *left = named(eyes, "eyeLeft"), *right = named(eyes, "eyeRight");
  ASSERT_TRUE(left && right);
  EXPECT_LE(norm(left->centre - kLeft), 0.01);
  EXPECT_LE(norm(right->centre - kRight), 0.01);
  EXPECT_NEAR(left->radius, kRadius, 0.012);
  EXPECT_GT(left->stored.size(), right->stored.size());  // the ball inside
}

TEST(Eyes, WithoutABallThereAreNone) {
  EXPECT_TRUE(findEyes(converted(withTargets(plane()))).empty());
  EXPECT_EQ(findEyes(converted(withTargets(uvSphere()))).size(), 1u) << "it is a ball itself";
}

TEST(Eyes, AreMostOfABallAndRound) {
  const auto isBall = [](const PolygonMesh& mesh) { return ballOf(mesh.positions).has_value(); };
  EXPECT_TRUE(isBall(cubeSphere(3)));
  EXPECT_FALSE(isBall(cubeSphere(2))) << "26 vertices";
  PolygonMesh cube = cubeSphere(4);
  for (Vec3& p : cube.positions) p *= 1 / std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  EXPECT_FALSE(isBall(cube));
}

/// The eyes found in a face made of balls, each given by its centre and radius.
std::vector<Eye> eyesOf(const std::vector<std::pair<Vec3, double>>& balls) {
  PolygonMesh mesh;
  for (const auto& [centre, radius] : balls) mesh = joined(mesh, cubeSphere(3, radius), centre);
  ConvertOptions options;
  options.tolerance = 0.05;
  return findEyes(convert(MeshRig{mesh, {}}, options).value().rig);
}

TEST(Eyes, AreAPairOfTheLargestBalls) {
  const Vec3 brow{0, 9, 0};
  const auto three = eyesOf({{brow, 1}, {kLeft, kRadius}, {kRight, kRadius}});
  EXPECT_EQ(three.size(), 2u);
  EXPECT_TRUE(named(three, "eyeLeft") && named(three, "eyeRight"));
  const auto unequal = eyesOf({{kLeft, kRadius / 2}, {kRight, kRadius}});
  ASSERT_EQ(unequal.size(), 1u);
  EXPECT_EQ(unequal[0].name, "eyeRight");
  EXPECT_TRUE(eyesOf({{kLeft, kRadius}, {kLeft + brow, kRadius}}).empty()) << "on one side";
}

TEST(Eyes, AreTheirCorneaTooButNotWhatIsBesideThem) {
  const auto storedWith = [](std::vector<std::pair<Vec3, double>> balls) {
    balls.insert(balls.end(), {{kLeft, kRadius}, {kRight, kRadius}});
    const auto eyes = eyesOf(balls);
    const Eye* left = named(eyes, "eyeLeft");
    return left ? left->stored.size() : 0;
  };
  const std::size_t alone = storedWith({});
  EXPECT_GT(storedWith({{kLeft + Vec3{0, 0, 0.1 * kRadius}, 0.95 * kRadius}}), alone) << "a cornea";
  EXPECT_EQ(storedWith({{kLeft + Vec3{0, 0, 1.25 * kRadius}, 0.2 * kRadius}}), alone) << "a lash";
}

TEST(EyeTurns, AreRigidAtEveryWeightAndOnlyThere) {
  const Rig& plain = convertedFace(false);
  Rig rig = plain;
  const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
  const auto rest = shown(plain, {});
  const std::size_t skin = 99;
  for (int k = 0; k <= 20; ++k) {
    std::vector<double> weights(rig.targets.size());
    weights[rig.find("eyeLookDown_L")] = k / 20.0;
    turns.apply(weights);
    const auto now = shown(rig, weights);
    EXPECT_LE(stretch(rest, now, skin, skin + 218), 1e-12);
    // It turns down by half a radian at weight 1.
    double way = 0;
    for (std::size_t v = skin; v < skin + 218; ++v) way = std::max(way, norm(now[v] - rest[v]));
    EXPECT_NEAR(way, 2 * kRadius * std::sin(0.25 * k / 20.0), 0.01);
    // Everything else moves as before.
    const auto before = shown(plain, {0, k / 20.0});
    for (std::size_t v = 0; v < skin; ++v) EXPECT_EQ(now[v], before[v]);
  }
}

TEST(EyeTurns, AreUsualOnesOfTargetsThatAreStillToCome) {
  Rig rig = convertedFace(false);
  const auto eyes = findEyes(rig);
  const Index down = rig.find("eyeLookDown_L");
  for (Target& target : rig.targets) target.difference.clear();
  const EyeTurns turns = EyeTurns::addTo(rig, eyes);
  std::vector<double> weights(rig.targets.size());
  weights[down] = 1;
  turns.apply(weights);
  EXPECT_NEAR(weights[rig.find("eyeLeft.down")], std::sin(0.5), 1e-12);
}

TEST(EyeTurns, GoTheUsualWayThatTheTargetIsNamedAfter) {
  // Left and right are the face's own: out is left for the left eye.
  const std::vector<std::pair<std::string, std::string>> ways{
      {"eyeLookUp_L", "eyeLeft.up"},    {"eyeLookDown_L", "eyeLeft.down"},
      {"eyeLookOut_L", "eyeLeft.left"}, {"eyeLookIn_L", "eyeLeft.right"},
      {"eyeLookUp_R", "eyeRight.up"},   {"eyeLookDown_R", "eyeRight.down"},
      {"eyeLookIn_R", "eyeRight.left"}, {"eyeLookOut_R", "eyeRight.right"}};
  Rig rig = makeRig(onePatch(1, 1));
  rig.targets.clear();
  for (const auto& [look, turn] : ways) rig.targets.push_back({look, {}, {}});
  const EyeTurns turns = EyeTurns::addTo(
      rig, std::vector<Eye>{{"eyeLeft", kLeft, kRadius, {}}, {"eyeRight", kRight, kRadius, {}}});
  for (const auto& [look, turn] : ways) {
    std::vector<double> weights(rig.targets.size());
    weights[rig.find(look)] = 1;
    turns.apply(weights);
    EXPECT_NEAR(weights[rig.find(turn)], std::sin(0.5), 1e-12) << look;
  }
}

TEST(EyeTurns, HaveNamesOfTheirOwn) {
  Rig rig = makeRig(onePatch(1, 1));
  rig.targets[1].name = "eyeLeft.down";
  EyeTurns::addTo(rig, std::vector<Eye>{{"eyeLeft", kLeft, kRadius, {}}});
  std::set<std::string> names;
  for (const Target& target : rig.targets) names.insert(target.name);
  EXPECT_EQ(names.size(), rig.targets.size());
}

TEST(EyeTurns, StayWholeWhereARegionEndsInABall) {
  Rig rig = convertedFace(false);
  Brush brush;
  brush.points = {kLeft - Vec3{0, kRadius, 0}};
  brush.whole = 1, brush.fade = kRadius, brush.alongSurface = false;
  auto regions = dividedFace(rig, {{"below", {}, paint(rig, brush).value()}}).value();
  const auto rest = shown(rig, {});
  const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
  // Turned in one region only, as when the other lags behind.
  std::vector<double> weights(2 * rig.targets.size());
  const auto late = std::span(weights).subspan(rig.targets.size());
  late[rig.find("eyeLookDown_L")] = 1;
  turns.apply(late);
  const auto stretched = [&] {
    std::vector<Vec3> vectors(rig.surface.vectorCount());
    blend(rig, regions, weights, vectors);
    const auto now = sourcePositions(rig, Tessellation(rig.surface, 1), vectors, {});
    return stretch(rest, now, 99, 99 + 218);
  };
  EXPECT_GT(stretched(), 0.05);
  auto influences = influencesOf(rig.surface, regions);
  turns.keepWhole(influences);
  turns.keepWhole(rig.surface, regions);
  EXPECT_LE(stretched(), 1e-12);
  EXPECT_EQ(influences, influencesOf(rig.surface, regions));
}

TEST(EyeTurns, GoAsFarAsTheTargetWent) {
  const Rig& plain = convertedFace(true);
  Rig rig = plain;
  const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
  const auto rest = shown(plain, {});
  const std::size_t skin = 99, end = skin + 218;
  double sagged = 0;
  for (int k = 0; k <= 20; ++k) {
    const double w = k / 20.0;
    std::vector<double> weights(rig.targets.size());
    weights[rig.find("eyeLookDown_L")] = w;
    turns.apply(weights);
    const auto now = shown(rig, weights), straight = shown(plain, {0, w});
    const Quaternion by = quaternionOf({0, 0.4 * w, 0});
    for (std::size_t v = skin; v < end; ++v) {
      EXPECT_LE(norm(now[v] - (kLeft + turned(by, rest[v] - kLeft))), 0.012);
      sagged = std::max(sagged, norm(rest[v] - kLeft) - norm(straight[v] - kLeft));
      if (k == 20) {
        EXPECT_LE(norm(now[v] - straight[v]), 1e-9);
      }
    }
  }
  EXPECT_GT(sagged, 0.02);  // what linear interpolation loses
}

TEST(EyeTurns, GoTheUsualWayWhereTheBallMovesByATraceAlone) {
  const auto leave = [](const Vec3& p) { return p + 0.01 * Vec3{std::sin(9 * p.x), 0, 0}; };
  const auto turn = [](const Vec3& p) {
    return kLeft + turned(quaternionOf({0, 0.003, 0}), p - kLeft);
  };
  for (const std::function<Vec3(const Vec3&)>& trace :
       {std::function(leave), std::function(turn)}) {
    MeshRig mesh = faceWithEyes(false);
    auto& looking = mesh.targets.back().positions;
    std::transform(looking.begin() + 99, looking.end(), looking.begin() + 99, trace);
    Rig rig = converted(mesh);
    const auto rest = shown(rig, {});
    const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
    std::vector<double> weights(rig.targets.size());
    weights[rig.find("eyeLookDown_L")] = 1;
    turns.apply(weights);
    const auto now = shown(rig, weights);
    double way = 0;
    for (std::size_t v = 99; v < 99 + 218; ++v) way = std::max(way, norm(now[v] - rest[v]));
    EXPECT_NEAR(way, 2 * kRadius * std::sin(0.25), 0.03);
  }
}

// A movement counts by how far it takes places, however many other vectors are stored there.
TEST(EyeTurns, GoTheUsualWayWhereTheBallMovesByLessThanAFiftiethOfItsRadius) {
  const Rig& plain = convertedFace(false);
  const auto way = [&](double share) {
    Rig rig = plain;
    Target& target = rig.targets[rig.find("eyeLookDown_L")];
    for (Index v = 0; v < rig.surface.storedCount(); ++v)
      if (rig.surface.stored(v).isPosition() && norm(rig.neutral[v] - kLeft) < 1.1 * kRadius)
        target.difference[v] = share * kRadius * Vec3{std::sin(9.0 * v), std::cos(9.0 * v), 0};
    const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
    std::vector<double> weights(rig.targets.size());
    weights[rig.find("eyeLookDown_L")] = 1;
    const auto before = shown(rig, weights);
    turns.apply(weights);
    const auto after = shown(rig, weights);
    double most = 0;
    for (std::size_t v = 99; v < 99 + 218; ++v) most = std::max(most, norm(after[v] - before[v]));
    return most;
  };
  EXPECT_NEAR(way(0.019), 2 * kRadius * std::sin(0.25), 0.03);
  EXPECT_LT(way(0.021), 0.1);  // noise, and no turn
}

TEST(EyeTurns, AreNotBentByArcsThatAreThereAlready) {
  Rig rig = convertedFace(true);
  const auto rest = shown(rig, {});
  const Index look = rig.find("eyeLookDown_L");
  const Followers arcs(addArcs(rig, std::vector{Turn{look, kLeft, {1, 0, 0}}}));
  const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
  std::vector<double> weights(rig.targets.size());
  weights[look] = 0.5;
  turns.apply(weights);
  arcs.apply(weights);
  const auto now = shown(rig, weights);
  const Quaternion by = quaternionOf({0, 0.2, 0});
  for (std::size_t v = 99; v < 99 + 218; ++v)
    EXPECT_LE(norm(now[v] - (kLeft + turned(by, rest[v] - kLeft))), 0.012);
}

TEST(EyeTurns, LookWhereTheAnglesSay) {
  Rig rig = convertedFace(false);
  const auto rest = shown(rig, {});
  const EyeTurns turns = EyeTurns::addTo(rig, findEyes(rig));
  const std::size_t skin = 99;
  // The front of the left eye.
  std::size_t front = skin;
  for (std::size_t v = skin; v < skin + 218; ++v)
    if (rest[v].z > rest[front].z) front = v;
  for (const auto& [yaw, pitch] : {std::pair{0.5, 0.0},
                                   {-0.3, 0.0},
                                   {0.0, 0.4},
                                   {0.3, -0.6},
                                   {0.0, 0.0},
                                   {2.5, 0.5},
                                   {std::numbers::pi, 0.0}}) {
    std::vector<double> weights(rig.targets.size());
    turns.apply(HeadPose{{}, {yaw, pitch, 0.7}, {}}, weights);
    const auto now = shown(rig, weights);
    const Vec3 before = normalized(rest[front] - kLeft), after = normalized(now[front] - kLeft);
    const Vec3 view = turned(quaternionOf({yaw, pitch, 0}), {0, 0, 1});
    EXPECT_NEAR(angleDegrees(before, after), angleDegrees({0, 0, 1}, view),
                angleDegrees(before, {0, 0, 1}) + 0.01);
    EXPECT_LE(angleDegrees(after, view), angleDegrees(before, {0, 0, 1}) + 0.01);
    EXPECT_LE(stretch(rest, now, skin, skin + 218), 1e-12);
  }
}

TEST(HeadAngles, TurnAsTheyAreDefined) {
  const auto look = [](const Angles& a, const Vec3& v) { return turned(quaternionOf(a), v); };
  constexpr double quarter = std::numbers::pi / 2;
  EXPECT_LE(norm(look({quarter, 0, 0}, {0, 0, 1}) - Vec3{1, 0, 0}), 1e-15);   // to its left
  EXPECT_LE(norm(look({0, quarter, 0}, {0, 0, 1}) - Vec3{0, -1, 0}), 1e-15);  // down
  EXPECT_LE(norm(look({0, 0, quarter}, {1, 0, 0}) - Vec3{0, 1, 0}), 1e-15);
  const Angles all{0.3, -0.5, 0.8};
  const Vec3 v{1, 2, 3};
  EXPECT_LE(norm(look(all, v) - look({0.3, 0, 0}, look({0, -0.5, 0}, look({0, 0, 0.8}, v)))),
            1e-14);
}

TEST(HeadAngles, AreFoundByTheirHeadings) {
  const Clip clip{{"jawOpen", "headYaw", "RightEyePitch"}, {0}, {0.1, 0.2, 0.3}};
  const ClipAngles angles(clip);
  EXPECT_TRUE(angles.head() && angles.eyes());
  EXPECT_EQ(angles.at(clip, 0), (HeadPose{{-0.2, 0, 0}, {}, {0, 0.3, 0}}));
  const ClipAngles none(Clip{{"jawOpen"}, {}, {}});
  EXPECT_FALSE(none.head() || none.eyes());
}

/// As in takes of Live Link Face: where EyeLookOutLeft, EyeLookInRight and EyeLookUp are active,
/// yaw and pitch are negative and roll is their product.
TEST(HeadAngles, OfCapturesLookWhereItsWeightsDo) {
  const Clip take{{"EyeLookOutLeft", "LeftEyeYaw", "LeftEyePitch", "LeftEyeRoll"},
                  {0},
                  {0.503, -0.36, -0.174, 0.062}};
  const Angles eye = ClipAngles(take).at(take, 0).leftEye;
  const Vec3 view = turned(quaternionOf(eye), {0, 0, 1});
  EXPECT_GT(view.x, 0.3) << "to the face's left, which is out for the left eye";
  EXPECT_GT(view.y, 0.1) << "up";
  EXPECT_EQ(betweenHands(eye), (Angles{-0.36, -0.174, 0.062}));
}

TEST(HeadAngles, TurnNothingWhereTheyAreAlways0) {
  const std::vector<std::string> names{"HeadYaw", "LeftEyePitch", "LeftEyeYaw"};
  const ClipAngles still(Clip{names, {0, 1}, {0, 0, 0, 0, 0, 0}});
  EXPECT_TRUE(still.head());
  EXPECT_FALSE(still.turnsHead() || still.eyes());
  const ClipAngles head(Clip{names, {0, 1}, {0, 0, 0, 0.1, 0, 0}});
  EXPECT_TRUE(head.turnsHead() && !head.eyes());
  const ClipAngles roll(Clip{{"LeftEyeYaw", "LeftEyeRoll"}, {0, 1}, {0, 0, 0, 0.1}});
  EXPECT_FALSE(roll.eyes());  // eyes do not use roll
  const ClipAngles eyes(Clip{names, {0, 1}, {0, 0, 0, 0, 0, 0.1}});
  EXPECT_TRUE(eyes.eyes() && !eyes.turnsHead());
  EXPECT_TRUE(ClipAngles::tells("LeftEyeYaw"));
}

TEST(EyesLong, OfTheRealFaceTurnRigidly) {
  SKIP_WITHOUT_REAL_FACES();
  const std::filesystem::path folder = std::filesystem::path(realFaces()) / "ictface";
  std::vector<std::filesystem::path> targets;
  for (const char* name : {"eyeLookDown_L", "eyeLookOut_L", "eyeLookIn_R", "eyeLookUp_R"})
    targets.push_back(folder / "expressions" / (std::string(name) + ".obj"));
  ConvertOptions options;
  options.tolerance = 0.02;
  const Rig plain = convert(readRig(folder / "neutral.obj", targets).value(), options).value().rig;
  Rig rig = plain;
  const auto eyes = findEyes(rig);
  ASSERT_EQ(eyes.size(), 2u);
  for (const Eye& eye : eyes) {
    fmt::print("{}: centre {:.3f} {:.3f} {:.3f}, radius {:.3f}, {} stored vectors\n", eye.name,
               eye.centre.x, eye.centre.y, eye.centre.z, eye.radius, eye.stored.size());
    EXPECT_LE(norm(eye.centre - Vec3{eye.centre.x > 0 ? 3.117 : -3.117, 3.602, 7.983}), 0.1);
  }
  const EyeTurns turns = EyeTurns::addTo(rig, eyes);
  const auto rest = shown(plain, {});
  // Ranges of source vertices: sclera and iris of the left and the right eye.
  constexpr std::array<std::size_t, 3> borders{21451, 23021, 24591};
  double most = 0;
  for (int k = 1; k <= 20; ++k) {
    std::vector<double> weights(rig.targets.size());
    for (std::size_t t = 0; t < plain.targets.size(); ++t) weights[t] = k / 20.0;
    turns.apply(weights);
    const auto now = shown(rig, weights);
    for (std::size_t e = 0; e < 2; ++e) {
      most = std::max(most, stretch(rest, now, borders[e], borders[e + 1], 23));
      EXPECT_GT(norm(now[borders[e]] - rest[borders[e]]) +
                    norm(now[borders[e] + 300] - rest[borders[e] + 300]),
                0.001);
    }
  }
  fmt::print("distances within an eye change by {:.2e}\n", most);
  EXPECT_LE(most, 1e-12);
}

}  // namespace
}  // namespace sweepface
