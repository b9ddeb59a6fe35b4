// The shape of the sample head, and what its expressions do to it.
//
// A site, an angle round the head and an angle down from its crown, becomes a point in two steps:
// slanted sections give the skull, jaw and neck; smooth bumps add the face. Lengths are in cm,
// y is up, +z the front, +x the head's own left.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sweepface/vec.hpp"

namespace sample {

using sweepface::Vec2;
using sweepface::Vec3;

constexpr double degree = std::numbers::pi / 180;

inline double square(double x) { return x * x; }
inline double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// ---- From sites to points ----

/// A place on the head: degrees around from the front to its left, and down from its crown.
struct Site {
  double around, down;
  double in = 0;    ///< depth below the skin, in cm
  double near = 0;  ///< 1 at the edge of an opening, 0 away from it
  Vec2 edge = {};   ///< the point of that edge, in the front view
};

/// A slanted section through the head: its foremost and rearmost points and half its width.
struct Section {
  double frontY, frontZ, backY, backZ, halfWidth;
};

/// One section for each ten degrees down from the crown, and one beyond each pole.
constexpr auto sections = std::to_array<Section>({
    {11.5, -4.0, 11.55, 1.0, -2.6}, {11.8, -1.5, 11.8, -1.5, 0},    {11.55, 1.0, 11.5, -4.0, 2.6},
    {10.8, 3.5, 10.7, -6.4, 4.8},   {9.6, 5.6, 9.3, -8.4, 6.4},     {8.0, 7.1, 7.4, -9.8, 7.4},
    {6.2, 8.1, 5.2, -10.6, 7.9},    {4.4, 8.6, 3.0, -10.8, 8.0},    {2.6, 8.7, 0.8, -10.5, 7.9},
    {0.9, 8.5, -1.4, -9.7, 7.7},    {-0.8, 8.4, -3.3, -8.7, 7.4},   {-2.4, 8.4, -5.0, -7.6, 7.1},
    {-4.0, 8.4, -6.5, -6.8, 6.75},  {-5.6, 8.3, -7.9, -6.3, 6.3},   {-7.3, 8.0, -9.2, -6.1, 5.8},
    {-8.9, 7.0, -10.4, -6.1, 5.2},  {-10.3, 4.7, -11.5, -6.2, 4.9}, {-12.2, 2.6, -12.9, -6.5, 4.7},
    {-13.9, 1.2, -14.0, -5.4, 3.6}, {-14.2, -2.1, -14.2, -2.1, 0},  {-14.0, -5.4, -13.9, 1.2, -3.6},
});

/// Catmull-Rom interpolation of one number of the sections.
inline double profile(double Section::* number, double down) {
  const int k = std::clamp(static_cast<int>(down / 10), 0, static_cast<int>(sections.size()) - 4);
  const double t = down / 10 - k, a = sections[k].*number, b = sections[k + 1].*number;
  const double c = sections[k + 2].*number, d = sections[k + 3].*number;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// The head without its face: slanted ellipses, a little narrower in front.
inline Vec3 loft(const Site& site) {
  const double s = std::sin(site.around * degree), c = std::cos(site.around * degree);
  const double front = (1 + c) / 2, down = site.down;
  const double narrowing = 1 - square(front) * (0.05 + 0.13 * smoothstep(80, 140, down));
  const auto slant = [&](double Section::* fore, double Section::* rear) {
    return std::lerp(profile(rear, down), profile(fore, down), front);
  };
  return {profile(&Section::halfWidth, down) * s * narrowing,
          slant(&Section::frontY, &Section::backY), slant(&Section::frontZ, &Section::backZ)};
}

/// The site that the loft puts at (x, y) in the front view, by Newton's method.
inline Site siteAt(Vec2 goal) {
  Site site{.around = goal.x * 9, .down = 85 - goal.y * 5.5};
  for (int step = 0; step < 12; ++step) {
    constexpr double h = 1e-4;
    const Vec3 p = loft(site);
    const Vec3 a = (loft({.around = site.around + h, .down = site.down}) - p) * (1 / h);
    const Vec3 d = (loft({.around = site.around, .down = site.down + h}) - p) * (1 / h);
    const double ex = goal.x - p.x, ey = goal.y - p.y, det = a.x * d.y - d.x * a.y;
    site.around += (ex * d.y - ey * d.x) / det;
    site.down += (a.x * ey - a.y * ex) / det;
  }
  return site;
}

// ---- The face: where its openings are, and its relief ----

/// A closed curve with two corners, upright in the front view. `angle` 0 is the corner at +x.
struct Loop {
  Vec2 centre;
  double halfWidth, up, down;
  double lift = 0;  ///< how much higher the corners are than the middle

  double across(double x) const { return std::min(1.0, square((x - centre.x) / halfWidth)); }
  double arch(double x) const { return std::pow(1 - across(x), 0.6); }
  double cornerLine(double x) const { return centre.y + lift * across(x); }
  Vec2 at(double angle) const {
    const double x = centre.x + halfWidth * std::cos(angle);
    return {x, cornerLine(x) + (angle > 0 ? up : -down) * arch(x)};
  }
};

constexpr Loop eyeHole{{3.05, 1.1}, 1.4, 0.95, 0.7, 0.1};
constexpr Loop eyeCrease{{3.05, 1.15}, 1.7, 1.35, 1.05, 0.1};
constexpr Loop mouthHole{{0, -5.3}, 2.3, 0.12, 0.12, 0.15};
constexpr Loop lipOutline{{0, -5.3}, 2.65, 0.75, 0.85, 0.2};

inline Loop mirrored(Loop loop) { return loop.centre.x = -loop.centre.x, loop; }

/// A smooth bump of height 1 at `centre`, with its radii.
inline double bump(Vec2 p, Vec2 centre, double rx, double ry) {
  return std::exp(-square((p.x - centre.x) / rx) - square((p.y - centre.y) / ry));
}

inline double nose(double x, double y) {
  const double rise = smoothstep(2.8, -2.4, y), drop = smoothstep(-3.9, -2.3, y);
  return 2.1 * std::pow(rise, 1.3) * drop * std::exp(-square(x / (0.6 + 0.6 * rise)));
}

inline double eyeball(double x, double y) { return 0.6 * bump({x, y}, {3.05, 1.1}, 1.4, 1.2); }

/// How far the face stands out of the loft, along z.
inline double relief(double x, double y) {
  const Vec2 p{x, y}, side{std::abs(x), y};
  const double brow = 0.45 * bump({side.x, y - 0.15 * side.x}, {2.3, 3.0}, 2.8, 0.9);
  const double socket = -0.8 * bump(side, {2.8, 1.2}, 1.8, 1.5) + eyeball(side.x, y);
  const double cheek = 0.6 * bump(side, {3.9, -2.2}, 1.8, 1.6);
  const double nostril = 0.7 * bump(side, {1.15, -2.5}, 0.6, 0.65);
  const double lips = 0.6 * bump(p, {0, -4.8}, 1.9, 0.6) + 0.55 * bump(p, {0, -5.9}, 1.6, 0.5);
  const double chin = 0.8 * bump(p, {0, -8.2}, 1.7, 1.1) - 0.3 * bump(p, {0, -6.8}, 1.7, 0.5);
  return brow + socket + cheek + nose(x, y) + nostril + lips + chin;
}

/// 1 on the face, 0 on the back of the head.
inline double isFront(const Vec3& p) { return smoothstep(0, 4, p.z); }

inline Vec3 neutralPoint(const Site& site) {
  const Vec3 p = loft(site);
  const Vec2 profile{p.z + 0.15 * p.y, p.y};
  const double ear =
      1.3 * bump(profile, {-1.4, -0.2}, 1.1, 2.1) - 0.6 * bump(profile, {-0.6, -0.3}, 0.7, 1.0);
  const double side = std::sin(site.around * degree);
  return p + Vec3{ear * side * std::abs(side), 0, isFront(p) * relief(p.x, p.y) - site.in};
}

// ---- Expressions: how far each moves a point of the neutral ----

struct Skin {
  Site site;
  Vec3 base;   ///< on the loft
  Vec3 point;  ///< with the relief
};

/// The lower jaw turns about its hinge; the corners of the mouth go half-way with it.
inline Vec3 jawOpen(const Skin& skin) {
  const Site& site = skin.site;
  const double x = skin.base.x + site.near * (site.edge.x - skin.base.x);
  const double under = mouthHole.cornerLine(x) - skin.base.y;
  const double closed = mouthHole.across(x) * (1 - smoothstep(0, 3.5, std::abs(under)));
  const double below = 0.5 + 0.5 * std::copysign(square(1 - closed), under);
  const double jaw = smoothstep(-1, 5, skin.base.z) * smoothstep(-14, -10, skin.base.y);
  const double angle = 17 * degree * below * jaw, c = std::cos(angle) - 1, s = std::sin(angle);
  const double y = skin.point.y + 1, z = skin.point.z + 0.5;
  return {0, c * y - s * z, s * y + c * z};
}

/// Both lids slide over the eyeball to a line between them, the upper one further.
inline Vec3 eyeBlink(const Skin& skin, double side) {
  const Vec2 edge{skin.site.edge.x * side, skin.site.edge.y};
  if (edge.x < 0 || edge.y < 0) return {};  // the mouth, or the other eye
  const double line = eyeHole.cornerLine(edge.x) - 0.15 * eyeHole.arch(edge.x);
  const double shift = 0.93 * skin.site.near * (line - edge.y);
  const double x = skin.base.x * side, y = skin.base.y;
  return {0, shift, eyeball(x, y + shift) - eyeball(x, y)};
}

inline Vec3 mouthSmile(const Skin& skin, double side) {
  const Vec2 p{skin.base.x * side, skin.base.y};
  const double corner = bump(p, {2.4, -5.3}, 1.8, 1.6), cheek = bump(p, {3.9, -2.6}, 1.6, 1.4);
  return isFront(skin.base) *
         Vec3{side * 0.75 * corner, 0.9 * corner + 0.35 * cheek, 0.4 * cheek - 0.5 * corner};
}

inline Vec3 browInnerUp(const Skin& skin) {
  const double up = isFront(skin.base) * bump({skin.base.x, skin.base.y}, {0, 3.4}, 2.6, 1.6);
  return {0, 0.9 * up, 0.1 * up};
}

inline Vec3 mouthPucker(const Skin& skin) {
  const Vec2 p{skin.base.x, skin.base.y};
  const double near = isFront(skin.base) * bump(p, mouthHole.centre, 2.9, 1.7);
  return {-0.42 * near * p.x, 0, 1.1 * near};
}

inline Vec3 noseSneerLeft(const Skin& skin) {
  const Vec2 p{skin.base.x, skin.base.y};
  const double wing = bump(p, {1.2, -2.5}, 1.0, 1.1), lip = bump(p, {1.4, -4.7}, 1.0, 0.8);
  const double brow = bump(p, {1.6, 3.0}, 1.4, 1.0);
  return isFront(skin.base) * Vec3{0.1 * wing, 0.7 * wing + 0.35 * lip - 0.35 * brow, 0.2 * wing};
}

}  // namespace sample
