#include "sweepface/tangents.hpp"

#include <cmath>
#include <random>

#include "sweepface/evaluator.hpp"

#include "eval/play.hpp"
#include "eval/textured.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The tessellation, render mesh and neutral tangents of a level; level 0 is the source.
struct Level {
  Index level;
  Tessellation grid;
  RenderMesh mesh;
  std::vector<Vec3> places;  // of the neutral's points
  Tangents tangents;

  Level(
      const Rig& rig, Index number, void (*change)(RenderMesh&) = [](RenderMesh&) {})
      : level(number),
        grid(rig.surface, std::max<Index>(1, level)),
        mesh(level == 0 ? renderSource(rig, grid) : renderGrid(rig, grid)) {
    change(mesh);
    tangents = neutralTangents(rig, grid, mesh, level);
    const auto vectors = blend(rig, {});
    places = level == 0 ? sourcePositions(rig, grid, vectors, {}) : grid.positions(vectors);
  }

  Vec3 middleOfTriangle(std::size_t triangle) const {
    Vec3 middle;
    for (int c = 0; c < 3; ++c)
      middle += places[mesh.pointOf(static_cast<Index>(mesh.triangles[3 * triangle + c]))];
    return (1.0 / 3) * middle;
  }

  std::vector<Vec3> normals(const Rig& rig, std::span<const Vec3> vectors) const {
    return level == 0 ? sourceNormals(rig, grid, vectors) : grid.normals(vectors);
  }
  Result<Evaluator> evaluator(const Rig& rig, double tolerance = 0.03) const {
    return Evaluator::make(rig, grid, mesh, tangents,
                           {.level = level, .positions = false, .derivativeTolerance = tolerance});
  }
};

/// u = 2 x + y, v = y - x / 2: the inverse has ∂P/∂u = (1, 1/2) / 2.5.
Vec2 slanted(const Vec3& p, const Vec3&) { return {2 * p.x + p.y, p.y - 0.5 * p.x}; }

TEST(Tangents, GoAlongUOfTextureCoordinates) {
  Rig rig = plainSheet();
  texture(rig, slanted);
  const Vec3 expected = normalized({1, 0.5, 0});
  for (const Index level : {0, 1, 3}) {
    const Level at(rig, level);
    const Tangents& found = at.tangents;
    ASSERT_EQ(static_cast<Index>(found.directions.size()), at.grid.vertexCount());
    for (const Vec3& t : found.directions) EXPECT_LE(norm(t - expected), 1e-6);
    EXPECT_EQ(found.signs, std::vector<float>(found.directions.size(), 1));
  }
}

TEST(Tangents, TellWhereTextureCoordinatesAreMirrored) {
  Rig rig = plainSheet();
  texture(rig, [](const Vec3& p, const Vec3&) { return Vec2{-p.x, p.y}; });
  const Tangents found = Level(rig, 0).tangents;
  for (const Vec3& t : found.directions) EXPECT_LE(norm(t - Vec3{-1, 0, 0}), 1e-6);
  EXPECT_EQ(found.signs, std::vector<float>(9, -1));
}

// Beyond x = 1 the texture coordinates are turned by a right angle.
TEST(Tangents, DifferOnBothSidesOfASeam) {
  Rig rig = plainSheet();
  texture(rig, [](const Vec3& p, const Vec3& middle) {
    return middle.x < 1 ? Vec2{p.x, p.y} : Vec2{10 + p.y, -p.x};
  });
  const Level source(rig, 0);
  const RenderMesh& mesh = source.mesh;
  const Tangents& found = source.tangents;
  ASSERT_EQ(mesh.copies.size(), 3u);
  for (std::size_t v = 0; v < found.directions.size(); ++v) {
    const Vec3 expected = mesh.texcoords[2 * v] < 5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    EXPECT_LE(norm(found.directions[v] - expected), 1e-6) << v;
  }
}

/// A sheet whose halves share the same piece of the texture, mirrored.
Rig foldedSheet() {
  Rig rig = plainSheet();
  texture(rig, [](const Vec3& p, const Vec3&) { return Vec2{std::abs(p.x - 1), p.y}; });
  return rig;
}

TEST(SplitMirrored, DoublesWhatBothSidesShare) {
  const Rig rig = foldedSheet();
  for (const Index level : {0, 1, 3}) {
    const Level shared(rig, level);
    ASSERT_TRUE(shared.mesh.copies.empty());
    const Level split(rig, level, splitMirrored);
    const RenderMesh& mesh = split.mesh;
    EXPECT_EQ(mesh.copies.size(), 2u * std::max(1, level) + 1);
    ASSERT_EQ(mesh.triangles.size(), shared.mesh.triangles.size());
    ASSERT_EQ(mesh.texcoords.size(), 2u * mesh.vertexCount());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const Index v = static_cast<Index>(mesh.triangles[k]), point = mesh.pointOf(v);
      EXPECT_EQ(point, static_cast<Index>(shared.mesh.triangles[k]));
      for (int c = 0; c < 2; ++c)
        EXPECT_EQ(mesh.texcoords[2 * v + c], shared.mesh.texcoords[2 * point + c]);
      const float side = split.middleOfTriangle(k / 3).x < 1 ? -1 : 1;
      EXPECT_EQ(split.tangents.signs[v], side);
      EXPECT_LE(norm(split.tangents.directions[v] - Vec3{side, 0, 0}), 1e-6);
    }
  }
}

TEST(SplitMirrored, LeavesWhatIsOfOneKind) {
  for (const double way : {1, -1, 0}) {
    Rig rig = plainSheet();
    texture(rig, [&](const Vec3& p, const Vec3&) { return Vec2{way * p.x, p.y}; });
    EXPECT_TRUE(Level(rig, 0, splitMirrored).mesh.copies.empty()) << way;
  }
  EXPECT_TRUE(Level(plainSheet(), 0, splitMirrored).mesh.copies.empty()) << "without a texture";
}

/// Triangles around vertex 0 that form a cone.
struct Fan {
  RenderMesh mesh;
  std::vector<Vec3> positions{{}}, normals{{0, 0, 1}};

  Fan() { mesh.points = 1, mesh.texcoords = {0, 0}; }

  /// A vertex on the rim, and its texture coordinates on the unit circle.
  std::uint32_t rim(double angle, double texture) {
    positions.push_back({std::cos(angle), std::sin(angle), 0.2});
    normals.push_back({0, 0, 1});
    mesh.texcoords.push_back(static_cast<float>(std::cos(texture)));
    mesh.texcoords.push_back(static_cast<float>(std::sin(texture)));
    return static_cast<std::uint32_t>(mesh.points++);
  }
  void triangle(std::uint32_t a, std::uint32_t b) {
    mesh.triangles.insert(mesh.triangles.end(), {0, a, b});
  }
  Tangents tangents() const { return tangentsOf(mesh, positions, normals); }
};

// As in MikkTSpace: each triangle's tangent, projected into the normal's plane, is weighted by the
// triangle's angle.
TEST(Tangents, AreAverages) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 200; ++run) {
    const double first = 0.05 + 2.9 * uniform(random), second = 0.05 + 2.9 * uniform(random);
    const double turn = 1.5 * uniform(random);  // of the second triangle's tangent
    Fan fan;
    const auto a = fan.rim(0, 0), b = fan.rim(first, first);
    const auto c = fan.rim(first, first - turn), d = fan.rim(first + second, first + second - turn);
    fan.triangle(a, b), fan.triangle(c, d);
    const Vec3 found = fan.tangents().directions[0];
    const Vec3 expected = normalized({first + second * std::cos(turn), second * std::sin(turn), 0});
    EXPECT_LE(norm(found - expected), 2e-4) << first << " " << second << " " << turn;
  }
}

TEST(Tangents, AreThoseOfTheLargerAngleWhereMirroredOnesMeet) {
  for (const double angle : {1.0, 2.0}) {
    Fan fan;
    const auto a = fan.rim(0, 0), b = fan.rim(angle, angle);
    const auto c = fan.rim(3.0, 2 * angle - 3.0);  // mirrored about the shared edge
    fan.triangle(a, b), fan.triangle(b, c);
    const Tangents found = fan.tangents();
    const double turned = angle < 1.5 ? 2 * angle : 0;
    EXPECT_LE(norm(found.directions[0] - Vec3{std::cos(turned), std::sin(turned), 0}), 1e-5);
    EXPECT_EQ(found.signs[0], angle < 1.5 ? -1 : 1);
  }
}

TEST(Tangents, AreNoneWhereNoTriangleTells) {
  Fan fan;
  const auto a = fan.rim(0, 1), b = fan.rim(1, 1), c = fan.rim(2, 1);  // texcoords in line
  fan.triangle(a, b), fan.triangle(b, c);
  const Tangents found = fan.tangents();
  EXPECT_EQ(found.directions, std::vector<Vec3>(4));
  EXPECT_EQ(found.signs, std::vector<float>(4, 1));
}

/// A linear map, stored as its columns.
using Linear = std::array<Vec3, 3>;
Vec3 operator*(const Linear& map, const Vec3& p) {
  return p.x * map[0] + p.y * map[1] + p.z * map[2];
}

/// The rig with a single target that applies a linear map to everything.
Rig mappedBy(Rig rig, const Linear& map) {
  Target target{"map", {}, {}};
  for (const Vec3& p : rig.neutral) target.difference.push_back(map * p - p);
  for (const Vec3& p : rig.source.loose) target.looseDifference.push_back(map * p - p);
  rig.targets = {target};
  return rig;
}

constexpr Linear kShear{{{1.3, 0, 0.2}, {0.5, 0.8, 0}, {0, -0.4, 1.1}}};

/// Rigs of every kind, textured by projection from above.
std::vector<Rig> texturedRigs() {
  std::vector<Rig> rigs;
  for (Rig rig :
       {plainSheet(), makeRig(onePatch(3, 2)), makeRig(tee()), makeRig(slice()), makeRig(fan(4))}) {
    texture(rig, [](const Vec3& p, const Vec3& middle) {
      return Vec2{p.x - 0.2 * p.z + (middle.x > 0.3 ? 9 : 0), p.y};
    });
    rigs.push_back(rig);
  }
  rigs[0].source.gridVertex.push_back(-1);  // and a vertex that no face uses
  rigs[0].source.loose = {{1, 2, 3}};
  return rigs;
}

// A linear map of the whole space transforms tangents as well.
TEST(EvaluatorOfTangents, TakesThemWhereTheSurfaceDoes) {
  for (const Rig& plain : texturedRigs())
    for (const Index level : {0, 1, 3}) {
      const Rig rig = mappedBy(plain, kShear);
      const Level at(rig, level);
      const RenderMesh& mesh = at.mesh;
      const auto evaluator = at.evaluator(rig, 1e-4).value();
      ASSERT_EQ(evaluator.vertexCount(), mesh.vertexCount());
      const auto normals = at.normals(rig, blend(rig, Weights{1.0}));
      const Played still = play(evaluator, {}), moved = play(evaluator, {1.0});
      for (Index v = 0; v < mesh.vertexCount(); ++v) {
        const Vec3& tangent = at.tangents.directions[v];
        if (norm(tangent) == 0) continue;
        EXPECT_LE(norm(vectorOf(still.tangents, v) - tangent), 2e-4)
            << v << " " << level << " " << rig.neutral.size();
        EXPECT_LE(norm(vectorOf(moved.tangents, v) - normalized(kShear * tangent)), 5e-3) << v;
        EXPECT_LE(norm(vectorOf(moved.normals, v) - normals[mesh.pointOf(v)]), 5e-3) << v;
      }
    }
}

TEST(EvaluatorOfTangents, GoesAlongTheSweepWhereThereAreNone) {
  const Rig rig = makeRig(onePatch(3, 2));
  const Level at(rig, 1);
  EXPECT_EQ(at.tangents.directions, std::vector<Vec3>(12)) << "there are no texture coordinates";
  const auto without = Evaluator::make(rig, at.grid, {.level = 1}).value();
  EXPECT_EQ(play(at.evaluator(rig).value(), {}).tangents, play(without, {}).tangents);
}

TEST(EvaluatorOfTangents, RefusesAnotherMesh) {
  Rig rig = plainSheet();
  texture(rig, slanted);
  Level once(rig, 1), twice(rig, 2);
  EXPECT_TRUE(once.evaluator(rig));
  twice.mesh = once.mesh;
  EXPECT_FALSE(twice.evaluator(rig)) << "of another level";
  twice.tangents = once.tangents;
  EXPECT_FALSE(twice.evaluator(rig));
  once.tangents.directions.pop_back();
  EXPECT_FALSE(once.evaluator(rig));
}

}  // namespace
}  // namespace sweepface
