// Ears and nostrils.
#pragma once

#include <numbers>

#include "head.hpp"

namespace sample {

/// The rings of an ear, from its root over the helix and the antihelix into the shell: shares of
/// the outline in front and behind, and the height above the ear's plane.
struct EarRing {
  double front, back, height;
};
constexpr std::array<EarRing, 7> earRings{{{.96, .72, -.35},
                                           {.92, 1.0, .0},
                                           {.87, .95, .3},
                                           {.78, .83, .05},
                                           {.62, .66, .15},
                                           {.44, .46, -.35},
                                           {.32, .32, -.55}}};

/// A point of a ring; angles are those of earRoot().
inline Vec3 earPoint(const EarRing& ring, double angle) {
  const Vec3 centre{7.75, .3, -.9}, up = normalized({.05, 1, -.2}), back = normalized({.5, 0, -1});
  const Vec3 out = cross(back, up);
  const double backward = -std::sin(angle), upward = -std::cos(angle);
  const double height = upward > 0 ? 2.9 : 2.75;
  const double width = (backward > 0 ? 1.9 : 1.15) * (1 + .25 * std::min(0.0, upward));
  const double rise = .5 + .5 * std::clamp(backward + .6 * upward, -1.0, 1.0);  // off the head
  const double share = std::lerp(ring.front, ring.back, rise);
  return centre + share * (width * backward * back + height * upward * up) +
         ring.height * rise * out;
}

inline void drawEar(Sketch& sketch, const Head& head) {
  for (int k = 0; k < kEarPlaces; ++k)
    sketch.pass(head.ear[k], head.ear[(k + 1) % kEarPlaces], earRoot(earAngle(k + .5)),
                {Part::ear, -1, k, true});
  Line outer = head.ear;
  for (int r = 0; r < static_cast<int>(earRings.size()); ++r) {
    const auto point = [&](double place) {
      const double angle = earAngle(place);
      return between(earRoot(angle), earPoint(earRings[r], angle), r == 0 ? .7 : 1);
    };
    Line line;
    for (int k = 0; k < kEarPlaces; ++k)
      line.push_back(sketch.add(point(k), {Part::ear, r, k}, fmt::format("ear {}.{}", r, k)));
    for (int k = 0; k < kEarPlaces; ++k)
      sketch.pass(line[k], line[(k + 1) % kEarPlaces], point(k + .5), {Part::ear, r, k, true});
    sketch.ring(outer, line, "skin");
    outer = line;
  }
  for (int k = 0; k + 1 < kEarPlaces / 2; ++k)
    sketch.patch(outer[k + 1], outer[k], outer[kEarPlaces - 1 - k], outer[kEarPlaces - 2 - k],
                 "skin");
}

inline void drawNostril(Sketch& sketch, const Head& head) {
  const auto& r = head.rows;
  const Line rim{r[nostrils][1], r[nostrils][2], r[noseBase][2], r[noseBase][1]};
  Vec3 middle;
  for (Index i : rim) middle += .25 * sketch.spot(i).at;
  struct Hole {
    double share, up;
  };
  constexpr std::array<Hole, 3> rings{{{.3, .05}, {.42, .45}, {.5, 1.0}}};
  Line outer = rim;
  for (int ring = 0; ring < 3; ++ring) {
    Line line;
    for (int k = 0; k < 4; ++k) {
      const Vec3 at =
          between(sketch.spot(rim[k]).at, middle, rings[ring].share) + Vec3{0, rings[ring].up, 0};
      line.push_back(
          sketch.add(at, {Part::nostril, ring, k}, fmt::format("nostril {}.{}", ring, k)));
    }
    sketch.ring(outer, line, ring == 0 ? "skin" : "nostril");
    outer = line;
  }
  sketch.patch(outer[3], outer[2], outer[1], outer[0], "nostril");
}

}  // namespace sample
