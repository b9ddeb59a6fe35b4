// The sample face has lids that close, lips that part, and no fold in any expression.
#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

#include "sweepface/eval.hpp"
#include "sweepface/head.hpp"

#include "../../examples/sample_face/face.hpp"

namespace sweepface {
namespace {

const Rig& face() {
  static const Rig rig = [] {
    auto built = build(sample::drawFace());
    EXPECT_TRUE(built.has_value()) << (built ? "" : built.error().message);
    return built ? std::move(built->rig) : Rig{};
  }();
  return rig;
}

Weights only(const std::vector<std::string>& names) {
  Weights weights(face().targets.size());
  for (const std::string& name : names) {
    const Index target = face().find(name);
    EXPECT_GE(target, 0) << name;
    if (target >= 0) weights[target] = 1;
  }
  return weights;
}

constexpr int kSamples = 64;  // of a curve

/// Points along a curve between two nodes, under weights.
std::vector<Vec3> curvePoints(const std::string& from, const std::string& to,
                              const Weights& weights) {
  const auto& names = face().names.curves;
  const auto found = std::ranges::find_if(names, [&](const std::string& name) {
    return name == from + " - " + to || name == to + " - " + from;
  });
  EXPECT_NE(found, names.end()) << from << " - " << to;
  if (found == names.end()) return {};
  const auto curve = static_cast<Index>(found - names.begin());
  const auto vectors = blend(face(), weights);
  std::vector<Vec3> points;
  for (int k = 0; k <= kSamples; ++k) {
    const auto w = face().surface.arcWeights(
        curve, face().surface.wireframe().arcs[curve].edges * k / static_cast<double>(kSamples));
    Vec3 p;
    for (std::size_t v = 0; v < w.vectors.size(); ++v) p += w.factors[v] * vectors[w.vectors[v]];
    points.push_back(p);
  }
  return points;
}

/// The edge of the left eye's upper or lower lid, where the eyeball is seen between them.
std::vector<Vec3> lid(bool upper, const Weights& weights) {
  std::vector<Vec3> line;
  for (int k = 1; k < 4; ++k) {
    const auto place = [&](int i) {
      return "left lid 2." + std::to_string(upper ? i : sample::kLidPlaces - i);
    };
    const auto points = curvePoints(place(k), place(k + 1), weights);
    line.insert(line.end(), points.begin(), points.end());
  }
  return line;
}

double farthest(const std::vector<Vec3>& line, const std::vector<Vec3>& other) {
  double far = 0;
  for (const Vec3& p : line) {
    double near = 1e9;
    for (const Vec3& q : other) near = std::min(near, norm(p - q));
    far = std::max(far, near);
  }
  return far;
}

/// The number of quads of the source mesh with two corners that face away from each other.
int folds(const Weights& weights) {
  const Tessellation grid(face().surface, 1);
  const auto positions = grid.positions(blend(face(), weights));
  int count = 0;
  for (const auto& quad : grid.faces()) {
    std::array<Vec3, 4> normals;
    for (int k = 0; k < 4; ++k) {
      const Vec3& p = positions[quad[k]];
      normals[k] = cross(positions[quad[(k + 1) % 4]] - p, positions[quad[(k + 3) % 4]] - p);
    }
    bool folded = false;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) folded = folded || dot(normals[a], normals[b]) < 0;
    count += folded;
  }
  return count;
}

TEST(SampleFace, isNotFoldedInAnyExpression) {
  EXPECT_EQ(folds(only({})), 0);
  for (const Target& target : face().targets)
    EXPECT_EQ(folds(only({target.name})), 0) << target.name;
}

TEST(SampleFace, hasTheExpressionsOfARKitUnderTheirNames) {
  const std::set<std::string> arkit{
      "browDownLeft",      "browDownRight",      "browInnerUp",         "browOuterUpLeft",
      "browOuterUpRight",  "cheekPuff",          "cheekSquintLeft",     "cheekSquintRight",
      "eyeBlinkLeft",      "eyeBlinkRight",      "eyeLookDownLeft",     "eyeLookDownRight",
      "eyeLookInLeft",     "eyeLookInRight",     "eyeLookOutLeft",      "eyeLookOutRight",
      "eyeLookUpLeft",     "eyeLookUpRight",     "eyeSquintLeft",       "eyeSquintRight",
      "eyeWideLeft",       "eyeWideRight",       "jawForward",          "jawLeft",
      "jawOpen",           "jawRight",           "mouthClose",          "mouthDimpleLeft",
      "mouthDimpleRight",  "mouthFrownLeft",     "mouthFrownRight",     "mouthFunnel",
      "mouthLeft",         "mouthLowerDownLeft", "mouthLowerDownRight", "mouthPressLeft",
      "mouthPressRight",   "mouthPucker",        "mouthRight",          "mouthRollLower",
      "mouthRollUpper",    "mouthShrugLower",    "mouthShrugUpper",     "mouthSmileLeft",
      "mouthSmileRight",   "mouthStretchLeft",   "mouthStretchRight",   "mouthUpperUpLeft",
      "mouthUpperUpRight", "noseSneerLeft",      "noseSneerRight",      "tongueOut"};
  EXPECT_GE(face().targets.size(), 40u);
  for (const Target& target : face().targets)
    EXPECT_TRUE(arkit.contains(target.name)) << target.name;
}

TEST(SampleFace, closesItsLids) {
  EXPECT_GT(farthest(lid(true, only({})), lid(false, only({}))), 1.0);
  const Weights shut = only({"eyeBlinkLeft"});
  EXPECT_LT(farthest(lid(true, shut), lid(false, shut)), 0.05);
}

// A lid that is shut lies on the eyeball, not in it.
TEST(SampleFace, keepsItsLidsOffTheEyeballs) {
  for (const auto& names : {std::vector<std::string>{}, {"eyeBlinkLeft"}, {"eyeWideLeft"}})
    for (const bool upper : {true, false})
      for (const Vec3& p : lid(upper, only(names)))
        EXPECT_GT(norm(p - sample::eyeCentre), sample::ballRadius);
}

TEST(SampleFace, partsItsLips) {
  const auto gap = [&](const Weights& weights) {
    const auto upper = curvePoints("mouth 3.0", "left mouth 3.1", weights);
    const auto lower = curvePoints("mouth 3.8", "left mouth 3.7", weights);
    return farthest(upper, lower);
  };
  EXPECT_LT(gap(only({})), 0.05);
  EXPECT_LT(gap(only({"mouthSmileLeft", "mouthSmileRight"})), 0.05);
  EXPECT_GT(gap(only({"jawOpen"})), 1.5);
}

TEST(SampleFace, isItsOwnMirrorImage) {
  const auto& names = face().names.nodes;
  std::map<std::string, Index> node;
  for (std::size_t n = 0; n < names.size(); ++n) node[names[n]] = static_cast<Index>(n);
  const auto place = [&](Index n, const std::vector<Vec3>& vectors) {
    const HalfArc arm = face().surface.connectivity().stars[n].arms[0];
    const Arc& arc = face().surface.wireframe().arcs[arcOf(arm)];
    const auto w = face().surface.arcWeights(arcOf(arm), arm & 1 ? arc.edges : 0);
    Vec3 p;
    for (std::size_t v = 0; v < w.vectors.size(); ++v) p += w.factors[v] * vectors[w.vectors[v]];
    return p;
  };
  const auto smile = blend(face(), only({"mouthSmileLeft"}));
  const auto mirror = blend(face(), only({"mouthSmileRight"}));
  int pairs = 0;
  for (const auto& [name, n] : node) {
    if (!name.starts_with("left ")) continue;
    ++pairs;
    const Vec3 left = place(n, smile), right = place(node.at("right " + name.substr(5)), mirror);
    EXPECT_LT(norm(left - Vec3{-right.x, right.y, right.z}), 1e-9) << name;
  }
  EXPECT_GT(pairs, 500);
}

// Its eyeLook targets turn the balls themselves: by 22° to 26°, along straight lines.
TEST(SampleFace, turnsItsEyesRigidlyAndAsFarAsBefore) {
  Rig rig = face();
  const auto eyes = findEyes(rig);
  ASSERT_EQ(eyes.size(), 2u);
  const EyeTurns turns = EyeTurns::addTo(rig, eyes);
  const Tessellation grid(rig.surface, 1);
  std::vector<bool> isEye(rig.surface.wireframe().nodes.size(), false);
  for (const Eye& eye : eyes)
    for (const Index v : eye.stored) isEye[rig.surface.stored(v).node] = true;
  std::vector<Index> ball;  // vertices of the left one
  for (Index v = 0; v < grid.vertexCount(); ++v) {
    const Site& site = grid.site(v);
    const Index node = rig.surface.connectivity().cornerNode[4 * site.patch];
    const Eye& left = eyes[0].name == "eyeLeft" ? eyes[0] : eyes[1];
    const Vec3 place = rig.surface.evaluate(blend(rig, {}), site);
    if (isEye[node] && norm(place - left.centre) < 1.1 * left.radius) ball.push_back(v);
  }
  ASSERT_GT(ball.size(), 50u);
  const auto shown = [&](const Rig& r, const Weights& weights) {
    return grid.positions(blend(r, weights));
  };
  const auto rest = shown(face(), {});
  for (const char* name : {"eyeLookDownLeft", "eyeLookUpLeft", "eyeLookInLeft", "eyeLookOutLeft"})
    for (const double w : {0.25, 0.5, 1.0}) {
      Weights weights = only({name});
      for (double& x : weights) x *= w;
      const auto before = shown(face(), weights);
      weights.resize(rig.targets.size());
      turns.apply(weights);
      const auto now = shown(rig, weights);
      double stretch = 0, straight = 0;
      for (const Index a : ball)
        for (const Index b : ball) {
          const double length = norm(rest[a] - rest[b]);
          stretch = std::max(stretch, std::abs(norm(now[a] - now[b]) - length));
          straight = std::max(straight, std::abs(norm(before[a] - before[b]) - length));
        }
      EXPECT_LE(stretch, 0.006) << name << " at " << w;  // its own end is off by as much
      if (w < 1) {
        EXPECT_GT(straight, 5 * stretch) << name << " at " << w;
      }
      for (std::size_t v = 0; w == 1 && v < now.size(); ++v)
        EXPECT_LE(norm(now[v] - before[v]), 1e-9) << name;
    }
}

}  // namespace
}  // namespace sweepface
