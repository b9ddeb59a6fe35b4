// Lips that meet, the hollow behind them, and teeth.
#pragma once

#include "head.hpp"

namespace sample {

constexpr int kLipPlaces = 9;  ///< 0 the middle above, 4 the corner, 8 the middle below
using LipLine = std::array<Vec3, kLipPlaces>;

struct LipRing {
  const char* material;  ///< of the patches outside it
  LipLine line;
};
// clang-format off
constexpr std::array<LipRing, 8> lipRings{{
    /* round the lips */ {"skin", {{{0, -4.15, 9.3}, {.5, -4.15, 9.36}, {1.45, -4.3, 8.8}, {2.6, -4.75, 7.95}, {3.05, -5.42, 7.35}, {2.65, -6.35, 7.58}, {1.55, -6.9, 8.3}, {.75, -6.98, 8.5}, {0, -7.0, 8.57}}}},
    /* outline */ {"skin", {{{0, -4.8, 9.47}, {.5, -4.7, 9.44}, {1.3, -4.9, 8.95}, {2.05, -5.2, 8.15}, {2.6, -5.4, 7.5}, {2.0, -5.85, 8.0}, {1.3, -6.2, 8.6}, {.6, -6.38, 8.92}, {0, -6.42, 9.0}}}},
    /* ridge */   {"lips", {{{0, -5.05, 9.75}, {.5, -5.02, 9.65}, {1.25, -5.13, 9.1}, {1.95, -5.33, 8.25}, {2.48, -5.4, 7.52}, {1.93, -5.68, 8.15}, {1.22, -5.88, 8.9}, {.55, -5.95, 9.3}, {0, -5.97, 9.38}}}},
    /* contact */ {"lips", {{{0, -5.47, 9.4}, {.5, -5.45, 9.32}, {1.2, -5.44, 8.85}, {1.9, -5.42, 8.1}, {2.36, -5.4, 7.5}, {1.9, -5.42, 8.08}, {1.2, -5.44, 8.83}, {.5, -5.45, 9.3}, {0, -5.47, 9.38}}}},
    /* inside */  {"lips", {{{0, -5.3, 8.8}, {.5, -5.3, 8.75}, {1.15, -5.3, 8.4}, {1.8, -5.36, 7.75}, {2.2, -5.42, 7.2}, {1.8, -5.6, 7.75}, {1.15, -5.65, 8.4}, {.5, -5.65, 8.75}, {0, -5.65, 8.8}}}},
    /* gums */    {"gums", {{{0, -4.4, 8.5}, {.5, -4.4, 8.45}, {1.2, -4.4, 8.1}, {1.9, -4.6, 7.4}, {2.3, -5.47, 6.8}, {1.9, -6.4, 7.4}, {1.2, -6.6, 8.1}, {.5, -6.6, 8.45}, {0, -6.6, 8.5}}}},
    /* cheeks */  {"gums", {{{0, -4.1, 7.0}, {.6, -4.1, 7.0}, {1.4, -4.1, 6.8}, {2.2, -4.5, 6.2}, {2.6, -5.5, 5.7}, {2.2, -6.5, 6.2}, {1.4, -6.9, 6.8}, {.6, -6.9, 7.0}, {0, -6.9, 7.0}}}},
    /* throat */  {"gums", {{{0, -4.3, 4.5}, {.6, -4.3, 4.5}, {1.3, -4.3, 4.5}, {1.9, -4.6, 4.5}, {2.1, -5.5, 4.4}, {1.9, -6.4, 4.5}, {1.3, -6.6, 4.5}, {.6, -6.6, 4.5}, {0, -6.6, 4.5}}}},
}};
// clang-format on
constexpr int kInnerLip = 4;  ///< rings up to this one are lips, the others the hollow

inline void drawMouth(Sketch& sketch, const Head& head) {
  const auto& r = head.rows;
  Line outer{r[noseBase][0], r[noseBase][1], r[noseBase][2], r[noseBase][3], r[mouth][3],
             r[underLip][3], r[underLip][2], r[underLip][1], r[underLip][0]};
  for (int ring = 0; ring < static_cast<int>(lipRings.size()); ++ring) {
    Line line;
    for (int k = 0; k < kLipPlaces; ++k)
      line.push_back(sketch.add(lipRings[ring].line[k],
                                {ring > kInnerLip ? Part::bag : Part::lips, ring, k},
                                fmt::format("mouth {}.{}", ring, k)));
    sketch.ring(outer, line, lipRings[ring].material, false);
    outer = line;
  }
  // The end of the hollow: two rows of patches between the upper and the lower half of the ring.
  Line middle;
  for (int k = 0; k < 3; ++k)
    middle.push_back(
        sketch.add({.7 * k, -5.5, 4.0}, {Part::bag, 9, k}, fmt::format("mouth back {}", k)));
  middle.push_back(outer[4]);
  const Line below{outer[8], outer[7], outer[6], outer[5]},
      above{outer[0], outer[1], outer[2], outer[3]};
  sketch.strip(below, middle, "gums");
  sketch.strip(middle, above, "gums");
}

/// A row of teeth: a band along an arch, round its biting edge.
inline void drawTeeth(Sketch& sketch, Part part, std::string_view name, double gum, double edge,
                      double front) {
  const bool upper = gum > edge;
  const double height = gum - edge;
  const std::array<Vec2, 4> section{
      // up and forward, from the gum in front to the back
      {{gum, 0}, {edge + .25 * height, .02}, {edge, -.18}, {edge + .4 * height, -.5}}};
  Line last;
  for (int row = 0; row < 4; ++row) {
    Line line;
    for (int k = 0; k < 5; ++k) {
      const double x = .47 * k, forward = section[row].y;
      const Vec3 at{x * (1 + .1 * forward), section[row].x, front - .34 * x * x + forward};
      line.push_back(sketch.add(at, {part, row, k}, fmt::format("{} teeth {}.{}", name, row, k)));
    }
    if (row > 0 && upper) sketch.strip(line, last, "teeth");
    if (row > 0 && !upper) sketch.strip(last, line, "teeth");
    last = line;
  }
}

inline void drawTeeth(Sketch& sketch) {
  drawTeeth(sketch, Part::upperTeeth, "upper", -4.5, -5.62, 8.2);
  drawTeeth(sketch, Part::lowerTeeth, "lower", -6.5, -5.5, 7.95);
}

}  // namespace sample
