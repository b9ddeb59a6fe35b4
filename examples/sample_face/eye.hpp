// Eyeballs and the lids that slide over them.
#pragma once

#include <numbers>

#include "head.hpp"

namespace sample {

constexpr Vec3 eyeCentre{3.15, 1.0, 6.78};
constexpr double ballRadius = 1.38;
constexpr int kLidPlaces =
    10;  ///< 0 the inner corner, 1 to 4 above, 5 the outer corner, 6 to 9 below

/// A lid's line in the front view of the eye, x towards the temple.
using LidLine = std::array<Vec2, kLidPlaces>;
constexpr LidLine lidEdge{{{-1.55, -.24},
                           {-1.0, .27},
                           {-.32, .56},
                           {.42, .6},
                           {1.05, .39},
                           {1.55, .0},
                           {1.05, -.4},
                           {.35, -.6},
                           {-.38, -.62},
                           {-1.05, -.48}}};
constexpr LidLine lidFold{{{-1.8, -.2},
                           {-1.28, .66},
                           {-.38, 1.0},
                           {.5, 1.03},
                           {1.35, .76},
                           {1.85, .0},
                           {1.3, -.75},
                           {.4, -1.05},
                           {-.42, -1.07},
                           {-1.25, -.82}}};

/// A point in front of the eyeball, `radius` from its centre; beyond its rim the skin continues
/// straight.
inline Vec3 overBall(Vec2 p, double radius) {
  const double away = std::hypot(p.x, p.y), rim = .8 * radius;
  double depth = std::sqrt(radius * radius - std::min(away, rim) * std::min(away, rim));
  depth -= 4.0 / 3 * std::max(0.0, away - rim);
  constexpr double turn = 8 * std::numbers::pi / 180;  // eyes look forward, their sockets outwards
  return eyeCentre + Vec3{p.x * std::cos(turn) + depth * std::sin(turn), p.y,
                          depth * std::cos(turn) - p.x * std::sin(turn)};
}

inline Vec2 mix(Vec2 a, Vec2 b, double t) {
  return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
}

/// A point of a line, or smoothly between two of them.
inline Vec2 at(const LidLine& line, const Mark& mark) {
  const auto p = [&](int k) { return line[(mark.place + k + kLidPlaces) % kLidPlaces]; };
  return mark.after ? mix(mix(p(0), p(1), .5), mix(p(-1), p(2), .5), -.125) : p(0);
}

/// The rings of the lids, from the fold inwards.
constexpr int kLidRings = 5;
inline Vec3 lidPoint(const Mark& mark, const LidLine& edge, const LidLine& fold) {
  const Vec2 e = at(edge, mark), f = at(fold, mark);
  const bool corner = mark.place % 5 == 0;
  const double outwards = corner && !mark.after ? 0 : mark.place < 5 ? .05 : -.05;
  switch (mark.ring) {
    case 0:
      return overBall(f, ballRadius + (mark.place > 5 ? .22 : .26));
    case 1:
      return overBall(mix(e, f, corner && !mark.after ? (mark.place == 0 ? .6 : .4) : .5),
                      ballRadius + .2);
    case 2:
      return overBall(e, ballRadius + .15);
    case 3:
      return overBall({.98 * e.x, e.y + outwards}, ballRadius + .03);
    default:  // behind the lid; at the corners down to the eyeball
      if (corner) return overBall({.96 * e.x, .96 * e.y}, ballRadius - .1);
      return overBall(mix(mix(e, lidEdge[mark.place], .5), f, .7), ballRadius + .03);
  }
}

/// The lids' line when they have come the shares `upper` and `lower` of the way to where they meet.
inline LidLine closedBy(double upper, double lower) {
  LidLine line = lidEdge;
  constexpr std::array<double, 5> share{0, .14, .18, .25, .4};  // of the way up from the lower lid
  for (int k = 1; k <= 4; ++k) {
    const Vec2 meet = mix(lidEdge[kLidPlaces - k], lidEdge[k], share[k]);
    const Vec2 middle{(lidEdge[k].x + lidEdge[kLidPlaces - k].x) / 2, meet.y};
    line[k] = mix(lidEdge[k], middle, upper);
    line[kLidPlaces - k] = mix(lidEdge[kLidPlaces - k], middle, lower);
  }
  return line;
}

inline void drawLids(Sketch& sketch, const Head& head) {
  const auto& r = head.rows;
  Line outer{r[eye][3], r[brow][3],     r[brow][4],     r[brow][5],     r[brow][6],
             r[eye][6], r[underEye][6], r[underEye][5], r[underEye][4], r[underEye][3]};
  for (int ring = 0; ring < kLidRings; ++ring) {
    Line line;
    for (int k = 0; k < kLidPlaces; ++k) {
      const Mark mark{Part::lid, ring, k};
      line.push_back(
          sketch.add(lidPoint(mark, lidEdge, lidFold), mark, fmt::format("lid {}.{}", ring, k)));
    }
    // Where the lids meet, their edges must meet along the whole length.
    for (int k = 0; k < kLidPlaces && (ring == 2 || ring == 3); ++k) {
      const Mark mark{Part::lid, ring, k, true};
      sketch.pass(line[k], line[(k + 1) % kLidPlaces], lidPoint(mark, lidEdge, lidFold), mark);
    }
    sketch.ring(outer, line, "skin");
    outer = line;
  }
}

/// A sphere of rings round the line of sight: pupil, iris, white.
inline void drawEyeball(Sketch& sketch) {
  struct BallRing {
    double angle;
    const char* material;
  };
  constexpr double degree = std::numbers::pi / 180;
  constexpr std::array<BallRing, 6> rings{
      {{6, ""}, {11, "pupil"}, {25.5, "iris"}, {60, "sclera"}, {105, "sclera"}, {150, "sclera"}}};
  Line last;
  const auto at = [](double away, double round) {
    return eyeCentre + ballRadius * Vec3{std::sin(away) * std::cos(round),
                                         std::sin(away) * std::sin(round), std::cos(away)};
  };
  const auto cap = [&](const Line& ring, double away, bool front) {
    const Index middle =
        sketch.add(at(away, 0), {Part::ball, front ? -1 : 9, 0}, front ? "eye front" : "eye back");
    for (int k = 0; k < 8; k += 2) {
      const Index a = ring[k], b = ring[(k + 1) % 8], c = ring[(k + 7) % 8];
      if (front)
        sketch.patch(middle, c, a, b, "pupil");
      else
        sketch.patch(middle, b, a, c, "sclera");
    }
  };
  for (std::size_t r = 0; r < rings.size(); ++r) {
    Line ring;
    for (int k = 0; k < 8; ++k)
      ring.push_back(sketch.add(at(rings[r].angle * degree, (k + .5) * 45 * degree),
                                {Part::ball, static_cast<int>(r), k},
                                fmt::format("eyeball {}.{}", r, k)));
    if (r == 0)
      cap(ring, 0, true);
    else {
      for (int k = 0; k < 8; ++k)
        sketch.patch(ring[k], ring[(k + 1) % 8], last[(k + 1) % 8], last[k], rings[r].material);
    }
    last = ring;
  }
  cap(last, std::numbers::pi, false);
}

}  // namespace sample
