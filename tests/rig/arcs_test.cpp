#include "sweepface/arcs.hpp"

#include <numbers>

#include "codec/rigs.hpp"
#include "rig/taylor.hpp"
#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// ---- Taylor coefficients ----

/// f at (x, y) with all its derivatives, computed from those of x and y.
template <typename F>
Taylor taylorOf(F f, double x, double y) {
  Taylor a, b;
  a.c[0] = x, a.c[3] = 1;
  b.c[0] = y, b.c[1] = 1;
  return f(a, b);
}

TEST(Taylor, hasTheDerivativesOfWhatItComputes) {
  const auto f = [](const auto& x, const auto& y) {
    using std::sqrt;
    return sqrt(x * x + y * y * 2.0 + 1.0) * (x * y + 3.0);
  };
  const double x = 0.7, y = -0.4, h = 1e-2;
  const Taylor t = taylorOf(f, x, y);
  EXPECT_NEAR(t.value(), f(x, y), 1e-15);
  // Five-point central differences, with errors of order h⁴.
  constexpr std::array<std::array<double, 5>, 3> rule{
      {{0, 0, 1, 0, 0},
       {1 / 12.0, -8 / 12.0, 0, 8 / 12.0, -1 / 12.0},
       {-1 / 12.0, 16 / 12.0, -30 / 12.0, 16 / 12.0, -1 / 12.0}}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      for (int k = 0; k < 5; ++k)
        for (int l = 0; l < 5; ++l)
          sum += rule[i][k] * rule[j][l] * f(x + (k - 2) * h, y + (l - 2) * h);
      EXPECT_NEAR(t.derivative(i, j), sum / std::pow(h, i + j), 1e-6) << i << j;
    }
}

TEST(Taylor, inverseTimesItselfIsOne) {
  const Taylor a =
      taylorOf([](const Taylor& x, const Taylor& y) { return x * y + x * 2 + 5; }, 1, 2);
  const Taylor one = a * inverse(a);
  EXPECT_NEAR(one.value(), 1, 1e-15);
  for (int k = 1; k < 9; ++k) EXPECT_NEAR(one.c[k], 0, 1e-15) << k;
}

// ---- Bulges ----

Vec3 turnedAboutZ(const Vec3& p, const Vec3& pivot, double degrees) {
  const double a = degrees * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  const Vec3 q = p - pivot;
  return pivot + Vec3{c * q.x - s * q.y, s * q.x + c * q.y, q.z};
}

TEST(Bulge, putsTheMiddleOnTheArc) {
  const Turn turn{0, {1, 2, 3}, {0, 0, 1}};
  const Vec3 from{4, 1, 5};
  for (const double degrees : {1.0, 20.0, -45.0}) {
    const Vec3 to = turnedAboutZ(from, turn.pivot, degrees);
    const Vec3 middle = 0.5 * (from + to) + bulge(turn, from, to);
    EXPECT_LE(norm(middle - turnedAboutZ(from, turn.pivot, degrees / 2)), 1e-14) << degrees;
  }
}

// With arms of length 1 the middle of both lies at the cosine of half the angle.
TEST(Bulge, fadesOutTowardsAThirdOfAFullTurn) {
  const auto bulgeAt = [](double degrees) {
    const Vec3 from{1, 0, 0};
    return norm(bulge({0, {}, {0, 0, 1}}, from, turnedAboutZ(from, {}, degrees)));
  };
  const double full = 1 - std::cos(50 * std::numbers::pi / 180);
  EXPECT_GT(bulgeAt(100), 0.1 * full);
  EXPECT_LT(bulgeAt(100), 0.9 * full);
  for (int degrees = 50; degrees < 121; ++degrees)
    EXPECT_NEAR(bulgeAt(degrees + 1), bulgeAt(degrees), 0.01) << degrees;
}

TEST(Bulge, aboutAPointKeepsTheMeanDistance) {
  const Turn turn{0, {1, 0, 0}, {}};
  const Vec3 from{3, 1, 0}, to{2.8, 1, 1.2};
  const Vec3 middle = 0.5 * (from + to) + bulge(turn, from, to);
  EXPECT_NEAR(norm(middle - turn.pivot), 0.5 * (norm(from - turn.pivot) + norm(to - turn.pivot)),
              1e-14);
}

TEST(Bulge, isNoneWhereNothingTurns) {
  const Turn turn{0, {}, {0, 0, 1}};
  EXPECT_EQ(bulge(turn, {0, 0, 1}, {0, 0, 2}), Vec3{});       // on the axis
  EXPECT_EQ(bulge(turn, {1, 0, 0}, {-1, 0, 0}), Vec3{});      // half a turn
  EXPECT_EQ(bulge(turn, {1, 0, 0}, {-0.9, 0.1, 0}), Vec3{});  // nearly
  EXPECT_LE(norm(bulge(turn, {1, 0, 0}, {2, 0, 0})), 1e-15);  // straight away from the axis
  EXPECT_LE(norm(bulge(turn, {1, 0, 0}, {1, 0, 3})), 1e-15);  // along it
  // Beyond a third of a full turn.
  EXPECT_EQ(bulge(turn, {1, 0, 0}, turnedAboutZ({1, 0, 0}, {}, 130)), Vec3{});
}

// ---- Rigs ----

/// A surface whose first target turns it by `degrees` about an axis along z.
Rig turning(const Vec3& pivot, double degrees, const Wireframe& wireframe = onePatch(3, 2)) {
  Rig rig = makeRig(wireframe);
  rig.targets.resize(1);
  rig.tolerance = 0;
  rig.source.loose = {{1, 2, 3}};
  for (Index v = 0; v < rig.surface.storedCount(); ++v) {
    const StoredVector s = rig.surface.stored(v);
    const bool place = s.i == 0 && s.j == 0;
    const Vec3 p = rig.neutral[v];
    rig.targets[0].difference[v] = turnedAboutZ(p, place ? pivot : Vec3{}, degrees) - p;
  }
  rig.targets[0].looseDifference = {turnedAboutZ({1, 2, 3}, pivot, degrees) - Vec3{1, 2, 3}};
  return rig;
}

TEST(Arcs, turnTheSurfaceHalfWay) {
  const Vec3 pivot{-20, -30, 0};
  for (const Wireframe& wireframe : {onePatch(3, 2), fan(3), fan(5)}) {
    Rig rig = turning(pivot, 30, wireframe);
    const Turn turn{0, pivot, {0, 0, 1}};
    const Followers followers(addArcs(rig, {&turn, 1}));
    ASSERT_EQ(rig.targets.size(), 2u);
    EXPECT_EQ(rig.targets[1].name, rig.targets[0].name + ".arc");
    Weights weights{0.5, 0};
    followers.apply(weights);
    const auto half = blend(rig, weights), neutral = blend(rig, {});
    const Tessellation grid(rig.surface, 3);
    const auto places = grid.positions(half), before = grid.positions(neutral);
    for (std::size_t v = 0; v < places.size(); ++v)
      EXPECT_LE(norm(places[v] - turnedAboutZ(before[v], pivot, 15)), 1e-12) << v;
    EXPECT_LE(norm(blendLoose(rig, weights)[0] - turnedAboutZ({1, 2, 3}, pivot, 15)), 1e-12);
  }
}

TEST(Arcs, turnFoldedSurfacesHalfWayToo) {
  const Vec3 pivot{-20, -30, 0};
  const Wireframe straight = wheel(4, {0, 2}), corner = wheel(4, {0, 1});
  for (const Wireframe& wireframe : {straight, corner}) {
    Rig rig = turning(pivot, 30, wireframe);
    ASSERT_EQ(rig.surface.connectivity().kinds[0], NodeKind::creased);
    const Turn turn{0, pivot, {0, 0, 1}};
    const Followers followers(addArcs(rig, {&turn, 1}));
    Weights weights{0.5, 0};
    followers.apply(weights);
    const auto half = blend(rig, weights);
    for (Index v = 0; v < rig.surface.storedCount(); ++v) {
      const StoredVector s = rig.surface.stored(v);
      const auto& fans = rig.surface.connectivity().fans[s.node];
      if (!fans.empty() && !fans[static_cast<std::size_t>(s.fan)].regular) continue;
      const bool place = s.i == 0 && s.j == 0;
      EXPECT_LE(norm(half[v] - turnedAboutZ(rig.neutral[v], place ? pivot : Vec3{}, 15)), 1e-12)
          << v;
    }
  }
}

TEST(Arcs, changeNothingAtTheEnds) {
  const Rig plain = turning({-20, -30, 0}, 30);
  Rig rig = plain;
  const Turn turn{0, {-20, -30, 0}, {0, 0, 1}};
  const Followers followers(addArcs(rig, {&turn, 1}));
  for (const double w : {0.0, 1.0}) {
    Weights weights{w, 0};
    followers.apply(weights);
    EXPECT_EQ(blend(rig, weights), blend(plain, Weights{w}));
  }
}

TEST(Arcs, areNotAddedTwice) {
  Rig rig = turning({-20, -30, 0}, 30);
  const std::vector<Turn> turns{{0, {-20, -30, 0}, {0, 0, 1}}, {1, {-20, -30, 0}, {0, 0, 1}}};
  const auto first = addArcs(rig, std::span(turns).first(1));
  // When such a face is processed again, the arc itself may look like a turn.
  EXPECT_EQ(addArcs(rig, turns), first);
  EXPECT_EQ(rig.targets.size(), 2u);
}

}  // namespace
}  // namespace sweepface
