// What the expressions do: how far each moves a spot. Names and meanings are those of ARKit's blend
// shapes. Every motion is described for the left side; the right one is its mirror image.
#pragma once

#include <functional>

#include "eye.hpp"
#include "mouth.hpp"

namespace sample {

inline double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A smooth hill of height 1 in the front view.
inline double hill(const Vec3& p, Vec2 top, Vec2 radius) {
  return std::exp(-square((p.x - top.x) / radius.x) - square((p.y - top.y) / radius.y));
}

/// How far a spot follows the skin of the face: the eyes, the teeth and the back of the head do
/// not.
inline double softness(const Spot& s) {
  switch (s.mark.part) {
    case Part::ball:
    case Part::upperTeeth:
    case Part::lowerTeeth:
    case Part::ear:
      return 0;
    case Part::lid:
      return s.mark.ring == 0 ? .3 : 0;
    case Part::bag:
      return smoothstep(4.5, 9, s.at.z);
    default:
      return smoothstep(0, 4, s.at.z);
  }
}

// ---- Eyes ----

/// Moves the lids by these shares of the way to where they meet; the fold above follows its lid a
/// little.
inline Vec3 moveLids(const Spot& s, double upper, double lower) {
  if (s.mark.part != Part::lid || s.at.x < 0) return {};
  const LidLine edge = closedBy(upper, lower);
  LidLine fold = lidFold;
  for (int k = 0; k < kLidPlaces; ++k) fold[k].y += .25 * (edge[k].y - lidEdge[k].y);
  return lidPoint(s.mark, edge, fold) - lidPoint(s.mark, lidEdge, lidFold);
}

/// Turns the eyeball; angles in degrees.
inline Vec3 turnEye(const Spot& s, double outwards, double upwards) {
  if (s.mark.part != Part::ball || s.at.x < 0) return {};
  constexpr double degree = std::numbers::pi / 180;
  const Vec3 p = s.at - eyeCentre;
  const double o = outwards * degree, u = upwards * degree;
  const Vec3 a{p.x, p.y * std::cos(u) + p.z * std::sin(u), p.z * std::cos(u) - p.y * std::sin(u)};
  return Vec3{a.x * std::cos(o) + a.z * std::sin(o), a.y, a.z * std::cos(o) - a.x * std::sin(o)} -
         p;
}

inline Vec3 eyeBlink(const Spot& s) { return moveLids(s, 1, 1); }
inline Vec3 eyeWide(const Spot& s) { return moveLids(s, -.35, -.12); }
inline Vec3 cheekSquint(const Spot& s) {
  const double up = softness(s) * hill(s.at, {3.5, -1.6}, {1.7, 1.2});
  return Vec3{0, .45 * up, .25 * up} + moveLids(s, 0, .35);
}
inline Vec3 eyeSquint(const Spot& s) {
  const double up = softness(s) * hill(s.at, {3.3, -1.2}, {1.7, 1.0});
  return Vec3{0, .25 * up, .15 * up} + moveLids(s, .35, .75);
}
inline Vec3 eyeLookUp(const Spot& s) { return turnEye(s, 0, 22) + moveLids(s, -.25, -.1); }
inline Vec3 eyeLookDown(const Spot& s) { return turnEye(s, 0, -24) + moveLids(s, .45, -.25); }
inline Vec3 eyeLookIn(const Spot& s) { return turnEye(s, -26, 0); }
inline Vec3 eyeLookOut(const Spot& s) { return turnEye(s, 26, 0); }

// ---- Brows and nose ----

inline Vec3 browInnerUp(const Spot& s) {
  const double up = softness(s) * hill(s.at, {0, 3.6}, {2.7, 1.9});
  return {0, 1.0 * up, 0};
}
inline Vec3 browDown(const Spot& s) {
  const double down = softness(s) * hill(s.at, {2.0, 3.4}, {2.2, 1.5});
  return {-.25 * down, -.55 * down, .1 * down};
}
inline Vec3 browOuterUp(const Spot& s) {
  const double up = softness(s) * hill(s.at, {4.5, 3.4}, {1.7, 1.7});
  return {0, .85 * up, 0};
}
inline Vec3 noseSneer(const Spot& s) {
  const double wing = hill(s.at, {1.5, -2.3}, {1.0, 1.3}), lip = hill(s.at, {1.6, -4.6}, {1.0, .9});
  const double brow = hill(s.at, {1.3, 3.1}, {1.2, 1.3});
  return softness(s) * Vec3{.1 * wing, .7 * wing + .4 * lip - .35 * brow, .15 * wing};
}

// ---- Jaw and cheeks ----

/// How far a spot follows the lower jaw.
inline double withJaw(const Spot& s) {
  constexpr std::array<double, kLipPlaces> lip{0, 0, 0, .1, .45, .85, 1, 1, 1};
  switch (s.mark.part) {
    case Part::lowerTeeth:
      return 1;
    case Part::lips:
      return lip[s.mark.place];
    case Part::bag:
      return lip[s.mark.place % kLipPlaces] * (s.mark.ring > 6 ? .5 : 1);
    case Part::neck:
      return s.mark.ring < 2 ? (s.mark.ring < 1 ? .4 : .25) * smoothstep(-1, 2.5, s.at.z) : 0;
    case Part::head:
      break;
    default:
      return 0;
  }
  const double angle = std::atan2(s.at.y + 1, s.at.z) * 180 / std::numbers::pi;
  const double below = smoothstep(-18, -42, angle) * smoothstep(-1, 2, s.at.z);
  return below * smoothstep(1.5, 5, std::hypot(s.at.y + 1, s.at.z)) *
         (s.mark.ring == throat ? .55 : 1);
}

/// Turns the jaw about the joints in front of the ears.
inline Vec3 jawTurn(const Spot& s) {
  constexpr double angle = 13 * std::numbers::pi / 180;
  const double y = s.at.y + 1, z = s.at.z, c = std::cos(angle) - 1, sine = std::sin(angle);
  return {0, c * y - sine * z, sine * y + c * z};
}
inline Vec3 jawOpen(const Spot& s) { return withJaw(s) * jawTurn(s); }
inline Vec3 jawForward(const Spot& s) { return {0, 0, .6 * withJaw(s)}; }
inline Vec3 jawLeft(const Spot& s) { return {.65 * withJaw(s), 0, 0}; }

inline Vec3 cheekPuff(const Spot& s) {
  Vec3 p = s.at;
  const double side = p.x < 0 ? -1 : 1;
  p.x = std::abs(p.x);
  const double out = softness(s) * hill(p, {4.1, -4.6}, {1.7, 1.9});
  return {side * .6 * out, 0, .6 * out};
}

// ---- Mouth ----

inline Vec3 mouthSmile(const Spot& s) {
  const double corner = hill(s.at, {2.7, -5.4}, {1.8, 1.6}),
               cheek = hill(s.at, {3.9, -2.4}, {1.6, 1.5});
  return softness(s) * Vec3{.7 * corner, .9 * corner + .4 * cheek, .35 * cheek - .4 * corner} +
         moveLids(s, 0, .2);
}
inline Vec3 mouthFrown(const Spot& s) {
  const double corner = softness(s) * hill(s.at, {2.6, -5.6}, {1.5, 1.5});
  return {.1 * corner, -.6 * corner, -.1 * corner};
}
inline Vec3 mouthStretch(const Spot& s) {
  const double corner = softness(s) * hill(s.at, {2.9, -5.6}, {1.9, 1.5});
  return {.8 * corner, -.2 * corner, -.45 * corner};
}
inline Vec3 mouthPucker(const Spot& s) {
  const double near = softness(s) * hill(s.at, {0, -5.45}, {3.0, 1.8});
  return {-.42 * near * s.at.x, .2 * near * (s.at.y + 5.47), 1.0 * near};
}
/// How the lips part: 1 in the middle above, -1 in the middle below, 0 at the corners and away from
/// them.
inline double parting(const Spot& s) {
  constexpr std::array<double, kLipPlaces> share{1, 1, .85, .45, 0, -.45, -.85, -1, -1};
  constexpr std::array<double, 6> ring{.35, .8, 1, 1, 1, .5};
  const bool lips = s.mark.part == Part::lips || (s.mark.part == Part::bag && s.mark.ring < 6);
  return lips ? share[s.mark.place] * ring[s.mark.ring] : 0;
}
inline Vec3 mouthFunnel(const Spot& s) {
  const double near = softness(s) * hill(s.at, {0, -5.45}, {3.0, 1.8});
  return {-.32 * near * s.at.x, .5 * parting(s), .8 * near};
}
inline Vec3 mouthUpperUp(const Spot& s) {
  const double up = std::max(0.0, parting(s)) * smoothstep(-1.2, 1.2, s.at.x);
  const double wing = softness(s) * hill(s.at, {1.8, -3.6}, {1.0, .9});
  return {0, .5 * up + (s.mark.part == Part::lips ? 0 : .15 * wing), .1 * up};
}
inline Vec3 mouthLowerDown(const Spot& s) {
  const double down = std::min(0.0, parting(s)) * smoothstep(-1.2, 1.2, s.at.x);
  return {0, .5 * down, 0};
}
inline Vec3 mouthLeft(const Spot& s) {
  return {.8 * softness(s) * hill(s.at, {0, -5.6}, {3.2, 1.9}), 0, 0};
}

// ---- The list ----

using Motion = Vec3 (*)(const Spot&);
struct Expression {
  const char* name;
  Motion motion;
  bool sided;  ///< there is one for each side, with Left or Right after the name
};
// clang-format off
constexpr auto expressions = std::to_array<Expression>({
    {"eyeBlink", eyeBlink, true}, {"eyeWide", eyeWide, true}, {"eyeSquint", eyeSquint, true},
    {"eyeLookUp", eyeLookUp, true}, {"eyeLookDown", eyeLookDown, true},
    {"eyeLookIn", eyeLookIn, true}, {"eyeLookOut", eyeLookOut, true},
    {"browInnerUp", browInnerUp, false}, {"browDown", browDown, true}, {"browOuterUp", browOuterUp, true},
    {"noseSneer", noseSneer, true}, {"cheekSquint", cheekSquint, true}, {"cheekPuff", cheekPuff, false},
    {"jawOpen", jawOpen, false}, {"jawForward", jawForward, false}, {"jaw", jawLeft, true},
    {"mouthSmile", mouthSmile, true}, {"mouthFrown", mouthFrown, true},
    {"mouthStretch", mouthStretch, true}, {"mouthPucker", mouthPucker, false}, {"mouthFunnel", mouthFunnel, false},
    {"mouthUpperUp", mouthUpperUp, true}, {"mouthLowerDown", mouthLowerDown, true}, {"mouth", mouthLeft, true},
});
// clang-format on

/// What a motion of the side `of` (1 left, -1 right) does to the spot's node on `side`.
inline Vec3 moved(const Spot& spot, Motion motion, int of, int side) {
  Spot seen = spot;
  seen.at.x *= of * side;
  Vec3 by = motion(seen);
  by.x *= of;
  return by;
}

constexpr double kStill = .002;  ///< less than this, in cm, counts as no motion

inline void addExpression(Drawing& d, const Sketch& sketch, std::string name, Motion motion,
                          int of) {
  Drawing::Expression expression{std::move(name), {}, {}};
  const auto add = [&](std::string what, const Vec3& by, std::vector<Vec3> points) {
    Drawing::Move move;
    move.name = std::move(what), move.by = by, move.points = std::move(points);
    expression.moves.push_back(std::move(move));
  };
  for (Index i = 0; i < static_cast<Index>(sketch.spots().size()); ++i)
    for (const int side : {1, -1}) {
      if (side < 0 && sketch.inMiddle(i)) continue;
      const Vec3 by = rounded(moved(sketch.spot(i), motion, of, side));
      if (norm(by) >= kStill) add(sketch.nodeName(i, side), by, {});
    }
  for (const auto& [ends, spot] : sketch.passes())
    for (const int side : {1, -1}) {
      const Vec3 by = rounded(moved(spot, motion, of, side));
      if (norm(by) >= kStill) add(sketch.curveName(ends.first, ends.second, side), {}, {by});
    }
  d.expressions.push_back(std::move(expression));
}

inline void addExpressions(Drawing& d, const Sketch& sketch) {
  for (const auto& [name, motion, sided] : expressions) {
    if (!sided)
      addExpression(d, sketch, name, motion, 1);
    else {
      addExpression(d, sketch, fmt::format("{}Left", name), motion, 1);
      addExpression(d, sketch, fmt::format("{}Right", name), motion, -1);
    }
  }
}

}  // namespace sample
