#include <fmt/format.h>
#include <numbers>

#include "sweepface/arcs.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Vec3 turned(const Vec3& p, const Vec3& pivot, const Vec3& axis, double degrees) {  // Rodrigues
  const double a = degrees * std::numbers::pi / 180;
  const Vec3 q = p - pivot;
  return pivot + std::cos(a) * q + std::sin(a) * cross(axis, q) +
         (1 - std::cos(a)) * dot(axis, q) * axis;
}

Rig converted(const MeshRig& source) {
  ConvertOptions options;
  options.tolerance = 0.01;
  return convert(source, options).value().rig;
}

double fromLine(const Vec3& p, const Vec3& pivot, const Vec3& axis) {
  return norm(cross(p - pivot, axis));
}

/// A mesh with one target, in which `move` is applied to every vertex.
MeshRig moved(PolygonMesh mesh, const std::function<Vec3(const Vec3&)>& move) {
  MeshTarget target{"moved", {}};
  for (const Vec3& p : mesh.positions) target.positions.push_back(move(p));
  return {std::move(mesh), {target}};
}

TEST(Turns, findAnAxis) {
  const Vec3 pivot{-3, 1, -6}, axis = normalized({0.2, 1, 0.1});
  Rig rig = converted(moved(plane(), [&](const Vec3& p) { return turned(p, pivot, axis, 25); }));
  const std::vector<Turn> turns = findTurns(rig);
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_LE(norm(cross(turns[0].axis, axis)), 0.01);
  EXPECT_LE(fromLine(turns[0].pivot, pivot, axis), 0.1);
  rig.targets[0].difference.clear();
  EXPECT_TRUE(findTurns(rig).empty()) << "nobody has decoded what would turn";
}

TEST(Turns, aPartThatIsRigidTellsForAll) {
  // The plane follows the ball less and less towards one side, as a chin follows its teeth.
  const Vec3 pivot{5, 4, -20}, axis{1, 0, 0};
  MeshRig source = moved(joined(plane(), cubeSphere(4, 2), {5, 4, -8}), [&](const Vec3& p) {
    const double share = p.z < -4 ? 1 : 0.1 * p.y;
    return turned(p, pivot, axis, 20 * share);
  });
  const std::vector<Turn> turns = findTurns(converted(source));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_LE(norm(cross(turns[0].axis, axis)), 0.01);
  EXPECT_LE(fromLine(turns[0].pivot, pivot, axis), 0.1);
}

TEST(Turns, aLidTurnsAboutItsBall) {
  const Vec3 centre{0, 0, 0};
  const PolygonMesh ball = cubeSphere(6, 4);
  const PolygonMesh lid = grid(12, 6, [](double s, double t) {
    const double a = std::numbers::pi * (0.2 + 0.6 * s), b = std::numbers::pi * (0.1 + 0.2 * t);
    return Vec3{4.3 * std::cos(a), 4.3 * std::sin(a) * std::sin(b),
                4.3 * std::sin(a) * std::cos(b)};
  });
  const std::size_t ofBall = ball.positions.size();
  MeshRig source{joined(ball, lid, {}), {{"blink", {}}}};
  for (std::size_t v = 0; v < source.neutral.positions.size(); ++v) {
    const Vec3 p = source.neutral.positions[v];
    source.targets[0].positions.push_back(v < ofBall ? p : turned(p, centre, {1, 0, 0}, 35));
  }
  const std::vector<Turn> turns = findTurns(converted(source));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_EQ(turns[0].axis, Vec3{});
  EXPECT_LE(norm(turns[0].pivot - centre), 0.1);
}

TEST(Turns, aTwistIsNone) {
  const Rig rig = converted(
      moved(plane(), [](const Vec3& p) { return turned(p, {0, 4, 0}, {1, 0, 0}, 9 * p.x - 30); }));
  EXPECT_TRUE(findTurns(rig).empty());
}

// Another part turns about another axis: a lone triangle, or a corner of a sheet.
TEST(Turns, aPartThatIsTinyOrMostlyStillTellsNothing) {
  PolygonMesh triangle;
  triangle.positions = {{3, 3, 0}, {5, 3, 0}, {3, 5, 0}};
  addFace(triangle, {0, 1, 2});
  for (const PolygonMesh& other :
       {triangle, grid(4, 4, [](double x, double y) { return Vec3{x, y, 0}; })}) {
    const auto move = [](const Vec3& p) {
      if (p.x < 15) return turned(p, {5, 4, -20}, {1, 0, 0}, 2 * p.y);
      return p.x > 22.5 && p.y > 2.5 ? turned(p, {20, 0, -6}, {0, 1, 0}, 15) : p;
    };
    const std::vector<Turn> turns =
        findTurns(converted(moved(joined(plane(), other, {20, 0, 0}), move)));
    ASSERT_EQ(turns.size(), 1u);
    EXPECT_GT(std::abs(turns[0].axis.x), 0.8);
  }
}

TEST(Turns, keepAnAxisThatRunsThroughADistantBall) {
  const Vec3 pivot{0, 4, 0};
  const auto lid = [&](const Vec3& p) { return p.x > 15 ? p : turned(p, pivot, {1, 0, 0}, 25); };
  const std::vector<Turn> turns =
      findTurns(converted(moved(joined(plane(), cubeSphere(4, 3), {20, 4, 0}), lid)));
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_NEAR(std::abs(turns[0].axis.x), 1, 1e-3);
}

TEST(Turns, areNotSeenWhereThereAreNone) {
  EXPECT_TRUE(findTurns(converted(withTargets(plane(), 3))).empty());
  // A translation, a scaling, no movement, and a turn too small to matter.
  for (const auto& move : std::vector<std::function<Vec3(const Vec3&)>>{
           [](const Vec3& p) { return p + Vec3{1, 2, 3}; }, [](const Vec3& p) { return p * 1.2; },
           [](const Vec3& p) { return p; },
           [](const Vec3& p) { return turned(p, {0, 0, -9}, {1, 0, 0}, 2); }})
    EXPECT_TRUE(findTurns(converted(moved(plane(), move))).empty());
  EXPECT_TRUE(findTurns(converted({plane(), {}})).empty());
}

// ---- The full face of ICT-FaceKit ----

/// A target at 21 weights, with its arc and without.
class ArcStudy {
 public:
  ArcStudy(const Rig& plain, const std::string& name) : rig_(plain), target_(plain.find(name)) {
    for (const Turn& t : findTurns(plain))
      if (t.target == target_) turn = t;
    followers_ = Followers(addArcs(rig_, {&turn, 1}));
    const Tessellation grid(rig_.surface, 1);
    for (int k = 0; k <= 20; ++k) {
      Weights weights(rig_.targets.size());
      weights[target_] = k / 20.0;
      const Weights straight = weights;
      followers_.apply(weights);
      arc.push_back(sourcePositions(rig_, grid, blend(rig_, weights), weights));
      linear.push_back(sourcePositions(rig_, grid, blend(rig_, straight), straight));
    }
  }

  /// How far a vertex's distance falls below the linear interpolation of its end distances.
  double sag(const std::vector<std::vector<Vec3>>& way, Index v, auto distance) const {
    double worst = 0;
    const double from = distance(way.front()[v]), to = distance(way.back()[v]);
    for (int k = 0; k <= 20; ++k)
      worst = std::max(worst, std::lerp(from, to, k / 20.0) - distance(way[k][v]));
    return worst;
  }
  double largestSag(const std::vector<std::vector<Vec3>>& way, const std::vector<Index>& vertices,
                    auto distance) const {
    double worst = 0;
    for (const Index v : vertices) worst = std::max(worst, sag(way, v, distance));
    return worst;
  }

  /// The vertices that move further than a given share of the largest displacement.
  std::vector<Index> movers(double share) const {
    double longest = 0;
    for (std::size_t v = 0; v < arc[0].size(); ++v)
      longest = std::max(longest, norm(arc[20][v] - arc[0][v]));
    std::vector<Index> found;
    for (std::size_t v = 0; v < arc[0].size(); ++v)
      if (norm(arc[20][v] - arc[0][v]) > share * longest) found.push_back(static_cast<Index>(v));
    return found;
  }

  Turn turn;
  std::vector<std::vector<Vec3>> arc, linear;  ///< [21] source vertices

 private:
  Rig rig_;
  Index target_;
  Followers followers_;
};

Rig fullFace() {
  const std::filesystem::path folder = std::filesystem::path(realFaces()) / "ictface";
  std::vector<std::filesystem::path> targets;
  for (const char* name : {"eyeBlink_L", "eyeBlink_R", "jawOpen"})
    targets.push_back(folder / "expressions" / (std::string(name) + ".obj"));
  ConvertOptions options;
  options.tolerance = 0.02;
  return convert(readRig(folder / "neutral.obj", targets).value(), options).value().rig;
}

// Source vertices of the ICT face's parts, from its vertex_indices.json and its connected parts.
constexpr Index kFirstLowerTeeth = 19247, kLastLowerTeeth = 21450;

TEST(ArcsLong, lidsGoOverTheEyeballAndTheJawAboutItsHinge) {
  SKIP_WITHOUT_REAL_FACES();
  const Rig rig = fullFace();
  for (const char* name : {"eyeBlink_L", "eyeBlink_R"}) {
    const ArcStudy blink(rig, name);
    ASSERT_EQ(blink.turn.axis, Vec3{}) << name;
    const auto distance = [&](const Vec3& p) { return norm(p - blink.turn.pivot); };
    const auto lids = blink.movers(0.05);
    const double straight = blink.largestSag(blink.linear, lids, distance);
    const double arc = blink.largestSag(blink.arc, lids, distance);
    fmt::print("{}: {} vertices sag by {:.4f} on straight lines and {:.4f} on arcs\n", name,
               lids.size(), straight, arc);
    EXPECT_GT(straight, 0.05);
    EXPECT_LE(arc, 0.1 * straight);
  }

  const ArcStudy jaw(rig, "jawOpen");
  const Vec3 leftRight{1, 0, 0};
  EXPECT_LE(angleDegrees(jaw.turn.axis.x < 0 ? -jaw.turn.axis : jaw.turn.axis, leftRight), 5);
  const auto distance = [&](const Vec3& p) { return fromLine(p, jaw.turn.pivot, jaw.turn.axis); };
  const auto chin = jaw.movers(0.6);
  const double straight = jaw.largestSag(jaw.linear, chin, distance);
  const double arc = jaw.largestSag(jaw.arc, chin, distance);
  fmt::print("jawOpen: {} vertices sag by {:.4f} on straight lines and {:.4f} on arcs\n",
             chin.size(), straight, arc);
  EXPECT_GT(straight, 0.1);
  EXPECT_LE(arc, 0.1 * straight);

  // The lower teeth stay rigid throughout.
  double stretch = 0, straightStretch = 0;
  for (Index a = kFirstLowerTeeth; a <= kLastLowerTeeth; a += 37)
    for (Index b = a + 37; b <= kLastLowerTeeth; b += 37)
      for (int k = 0; k <= 20; ++k) {
        const double rest = norm(jaw.arc[0][a] - jaw.arc[0][b]);
        stretch = std::max(stretch, std::abs(norm(jaw.arc[k][a] - jaw.arc[k][b]) - rest));
        straightStretch =
            std::max(straightStretch, std::abs(norm(jaw.linear[k][a] - jaw.linear[k][b]) - rest));
      }
  fmt::print("lower teeth: distances change by {:.4f} on straight lines and {:.4f} on arcs\n",
             straightStretch, stretch);
  EXPECT_LE(stretch, 0.02 + 2 * 0.02);
  EXPECT_GT(straightStretch, stretch);
}

}  // namespace
}  // namespace sweepface
