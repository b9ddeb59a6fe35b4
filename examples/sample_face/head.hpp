// Skull, face, jaw and neck: rows from the middle of the face to the ear, like the ribs of a ship.
#pragma once

#include <array>
#include <numbers>
#include <span>

#include "sketch.hpp"

namespace sample {

constexpr int kColumns = 9;  ///< 0 in the middle, 8 at the ear
inline double square(double x) { return x * x; }

constexpr int kEar = kColumns - 1;

/// A smooth curve through points (Catmull and Rom), t from 0 to 1 along its chords.
inline Vec3 along(std::span<const Vec3> points, double t) {
  const auto last = static_cast<int>(points.size()) - 1;
  std::vector<double> at{0};
  for (int k = 1; k <= last; ++k) at.push_back(at.back() + norm(points[k] - points[k - 1]));
  const double goal = t * at.back();
  int k = 0;
  while (k + 1 < last && at[k + 1] < goal) ++k;
  const double span = at[k + 1] - at[k], u = (goal - at[k]) / span;
  const auto slope = [&](int i) {
    if (i == 0) return Vec3{points[1].x * span / at[1], 0, 0};  // level in the middle of the face
    const int a = i - 1, b = std::min(last, i + 1);
    return (points[b] - points[a]) * (span / (at[b] - at[a]));
  };
  const double v = 1 - u;
  return (1 + 2 * u) * v * v * points[k] + u * v * v * slope(k) +
         u * u * (3 - 2 * u) * points[k + 1] - u * u * v * slope(k + 1);
}

/// The rows, from under the chin up the face, over the crown and down to the nape.
enum Row : int {
  throat,
  jaw,
  chin,
  underLip,
  mouth,
  noseBase,
  nostrils,
  noseTip,
  noseBack,
  underEye,
  eye,
  brow,
  browTop,
  forehead,
  foreheadTop,
  hairline,
  crown,
  crownBack,
  back,
  occiput,
  neckline,
  nape,
  hollow,
  rowCount
};

/// Face rows have a point for every column.
using FaceRow = std::array<Vec3, kColumns>;
// clang-format off
constexpr std::array<FaceRow, browTop - chin + 1> faceRows{{
    /* chin */     {{{0, -9.0, 8.8}, {.6, -9.0, 8.72}, {1.3, -8.95, 8.4}, {2.3, -8.6, 7.5}, {3.5, -8.0, 6.1}, {4.6, -7.1, 4.4}, {5.45, -6.0, 2.8}, {6.05, -4.3, 1.4}, {6.8, -2.3, .7}}},
    /* underLip */ {{{0, -7.6, 8.5}, {.8, -7.6, 8.42}, {1.7, -7.5, 8.03}, {2.9, -7.2, 7.1}, {4.0, -6.7, 5.95}, {4.95, -5.9, 4.5}, {5.7, -4.9, 3.2}, {6.25, -3.5, 1.8}, {6.9, -1.85, .85}}},
    /* mouth */    {{{}, {}, {}, {3.55, -5.45, 7.1}, {4.35, -5.1, 6.3}, {5.2, -4.6, 4.95}, {5.95, -3.8, 3.6}, {6.45, -2.7, 2.1}, {7.0, -1.35, .95}}},
    /* noseBase */ {{{0, -3.6, 9.3}, {.48, -3.62, 9.2}, {1.42, -3.52, 8.65}, {2.85, -3.55, 8.0}, {4.15, -3.6, 7.15}, {5.25, -3.4, 5.8}, {6.1, -2.8, 4.1}, {6.62, -1.9, 2.3}, {7.1, -.85, 1.0}}},
    /* nostrils */ {{{0, -3.2, 10.35}, {.42, -3.28, 10.15}, {1.62, -3.15, 9.2}, {2.45, -2.9, 8.15}, {3.8, -2.9, 7.5}, {5.1, -2.65, 6.2}, {6.05, -2.05, 4.4}, {6.6, -1.3, 2.5}, {7.15, -.4, 1.05}}},
    /* noseTip */  {{{0, -2.5, 11.25}, {.6, -2.5, 10.85}, {1.65, -2.35, 9.5}, {2.3, -2.1, 8.35}, {3.5, -2.2, 7.75}, {4.95, -1.95, 6.55}, {6.05, -1.35, 4.7}, {6.7, -.7, 2.65}, {7.2, .1, 1.1}}},
    /* noseBack */ {{{0, -1.5, 10.95}, {.55, -1.45, 10.7}, {1.25, -1.3, 9.55}, {1.95, -1.1, 8.45}, {3.1, -1.5, 7.95}, {4.5, -1.35, 6.95}, {5.7, -.75, 5.5}, {6.75, -.15, 2.75}, {7.22, .35, 1.1}}},
    /* underEye */ {{{0, .0, 10.15}, {.5, .05, 9.9}, {1.05, .1, 8.9}, {1.6, .0, 8.1}, {2.7, -.75, 7.95}, {3.95, -.7, 7.4}, {5.2, -.05, 6.15}, {6.8, .4, 3.05}, {7.25, .75, 1.1}}},
    /* eye */      {{{0, 1.5, 9.2}, {.45, 1.45, 9.0}, {.95, 1.3, 8.45}, {1.3, 1.15, 7.95}, {}, {}, {5.3, 1.2, 6.1}, {6.85, 1.35, 3.15}, {7.3, 1.5, .95}}},
    /* brow */     {{{0, 3.0, 9.5}, {.5, 3.0, 9.46}, {1.05, 2.95, 9.35}, {1.7, 2.8, 9.05}, {2.85, 3.05, 8.75}, {4.15, 3.0, 7.95}, {5.35, 2.5, 6.4}, {6.85, 2.35, 3.2}, {7.35, 2.2, .8}}},
    /* browTop */  {{{0, 3.7, 9.58}, {.52, 3.7, 9.55}, {1.1, 3.65, 9.44}, {1.77, 3.5, 9.2}, {2.95, 3.75, 8.87}, {4.25, 3.62, 7.98}, {5.45, 3.05, 6.35}, {6.87, 3.25, 3.15}, {7.4, 2.75, .4}}},
}};
// clang-format on

/// Where the ear grows from the head: `angle` from below up the front, over the top, down behind.
inline Vec3 earRoot(double angle) {
  const double behind = -std::sin(angle),
               y = .2 - (behind > 0 ? 2.45 + .25 * behind : 2.45) * std::cos(angle);
  const double z = -.9 - (behind > 0 ? 1.8 : 1.1) * behind - .18 * (y - .2);
  return {7.15 + .1 * y + .15 * std::max(0.0, behind), y, z};
}
constexpr int kEarPlaces = rowCount + 1;
/// The angle at which each row, and last the lobe, meets the ear; places in between are for the
/// curves from one to the next.
inline double earAngle(double place) {
  constexpr std::array<double, kEarPlaces + 1> degrees{8,   20,  32,  44,  56,  68,  80,  92,  103,
                                                       114, 125, 136, 147, 158, 170, 183, 197, 212,
                                                       229, 248, 268, 291, 316, 342, 368};
  const auto k = static_cast<std::size_t>(place);
  return std::lerp(degrees[k], degrees[k + 1], place - std::floor(place)) * std::numbers::pi / 180;
}

/// Any other row, drawn through a few points.
struct Rib {
  Row row;
  std::vector<Vec3> points;
};
inline const std::vector<Rib> ribs{
    {throat,
     {{0, -10.3, 4.5},
      {1.6, -10.15, 4.2},
      {3.4, -9.5, 2.6},
      {4.6, -8.3, .9},
      {5.45, -6.7, -.3},
      {6.2, -4.6, -.8},
      {6.85, -2.2, -.75}}},
    {jaw,
     {{0, -10.2, 7.4},
      {1.2, -10.1, 7.15},
      {2.6, -9.4, 6.1},
      {4.3, -8.0, 3.8},
      {5.5, -6.3, 1.3},
      {6.15, -4.6, .3},
      {6.9, -2.2, -.2}}},
    {forehead,
     {{0, 5.4, 9.45},
      {1.95, 5.4, 9.1},
      {4.4, 5.3, 7.5},
      {5.8, 5.0, 5.6},
      {6.8, 4.3, 3.0},
      {7.43, 3.1, .0}}},
    {foreheadTop, {{0, 7.9, 8.5}, {3.6, 7.6, 7.2}, {6.3, 6.0, 3.6}, {7.45, 3.35, -.5}}},
    {hairline, {{0, 10.1, 6.3}, {3.8, 9.55, 5.2}, {6.6, 7.0, 2.0}, {7.5, 3.45, -1.0}}},
    {crown, {{0, 11.55, 2.7}, {4.0, 10.75, 2.0}, {6.85, 7.8, .0}, {7.5, 3.4, -1.5}}},
    {crownBack, {{0, 11.95, -1.6}, {4.2, 11.05, -1.8}, {7.15, 7.8, -2.0}, {7.5, 3.1, -2.0}}},
    {back, {{0, 10.9, -5.9}, {4.0, 10.0, -5.6}, {7.1, 6.8, -3.9}, {7.45, 2.5, -2.45}}},
    {occiput, {{0, 8.3, -9.0}, {4.0, 7.6, -8.2}, {7.1, 4.8, -5.2}, {7.35, 1.7, -2.7}}},
    {neckline, {{0, 4.6, -10.4}, {4.1, 4.2, -9.3}, {6.9, 2.9, -5.9}, {7.2, .7, -2.75}}},
    {nape, {{0, .7, -10.1}, {4.0, .6, -8.9}, {6.5, .8, -5.8}, {7.0, -.4, -2.6}}},
    {hollow, {{0, -3.4, -8.4}, {3.5, -3.2, -7.3}, {5.7, -2.4, -4.5}, {6.65, -1.7, -2.0}}},
};
constexpr std::array<double, kColumns> kSpread{0, .1, .2, .31, .44, .58, .72, .86, 1};

struct Head {
  std::array<Line, rowCount> rows;  ///< [columns]; -1 where eye and mouth are
  Line ear;                         ///< the ear's ring, clockwise
};

inline bool inOpening(int row, int column) {
  return (row == eye && (column == 4 || column == 5)) || (row == mouth && column < 3);
}
/// Whether rings fill a cell between a row and the next: mouth, nostril, eye.
inline bool isOpen(int row, int column) {
  return ((row == underLip || row == mouth) && column < 3) || (row == noseBase && column == 1) ||
         ((row == underEye || row == eye) && column >= 3 && column < 6);
}

inline std::array<Vec3, kColumns> rowPoints(int row) {
  if (row >= chin && row <= browTop) return faceRows[row - chin];
  std::array<Vec3, kColumns> points;
  for (const Rib& rib : ribs)
    if (rib.row == row)
      for (int c = 0; c < kColumns; ++c) points[c] = along(rib.points, kSpread[c]);
  return points;
}

/// Smooths ripples in cheeks and forehead: damps fourth differences along the columns and keeps
/// what is smooth.
inline void fair(std::array<std::array<Vec3, kColumns>, rowCount>& points) {
  for (int pass = 0; pass < 8; ++pass) {
    auto next = points;
    for (int row = chin; row <= hairline; ++row)
      for (int c = row < underEye ? 4 : 0; c < kEar; ++c) {
        if (row >= underEye && row <= browTop && c < 7) continue;
        bool whole = true;
        for (int k = -2; k <= 2; ++k) whole &= !inOpening(row + k, c);
        if (whole)
          next[row][c] -=
              (1.0 / 16) * (points[row - 2][c] - 4 * points[row - 1][c] + 6 * points[row][c] -
                            4 * points[row + 1][c] + points[row + 2][c]);
      }
    points = next;
  }
}

inline Head drawHead(Sketch& sketch) {
  Head head;
  std::array<std::array<Vec3, kColumns>, rowCount> points;
  for (int row = 0; row < rowCount; ++row) points[row] = rowPoints(row);
  for (int row = 0; row < rowCount; ++row) points[row][kEar] = earRoot(earAngle(row));
  fair(points);
  for (int row = 0; row < rowCount; ++row) {
    for (int c = 0; c < kColumns; ++c)
      head.rows[row].push_back(inOpening(row, c) ? -1
                                                 : sketch.add(points[row][c], {Part::head, row, c},
                                                              fmt::format("face {}.{}", row, c)));
    head.ear.push_back(head.rows[row][kEar]);
  }
  for (int row = 0; row + 1 < rowCount; ++row)
    for (int c = 0; c + 1 < kColumns; ++c)
      if (!isOpen(row, c))
        sketch.patch(head.rows[row][c], head.rows[row][c + 1], head.rows[row + 1][c + 1],
                     head.rows[row + 1][c], row == brow && c >= 3 && c < 6 ? "eyebrow" : "skin");
  return head;
}

/// The uppermost ring of the neck: from the throat to behind the jaw, and from there to the nape.
inline std::vector<Vec3> underJaw() {
  constexpr std::array<Vec3, 5> front{{{0, -11.3, 3.85},
                                       {2.5, -10.7, 3.0},
                                       {4.1, -9.4, 1.1},
                                       {5.1, -7.7, -.8},
                                       {5.85, -5.3, -1.9}}};
  constexpr std::array<Vec3, 4> behind{
      {{0, -5.1, -8.05}, {3.4, -5.0, -7.0}, {5.3, -4.8, -4.6}, {5.9, -4.7, -3.0}}};
  std::vector<Vec3> ring;
  for (int c = 0; c < kColumns; ++c) ring.push_back(along(front, kSpread[c]));
  ring.push_back({5.9, -4.9, -2.4});
  for (int c = kEar; c >= 0; --c) ring.push_back(along(behind, kSpread[c]));
  return ring;
}

/// A slanted ring of the neck, `count` places from the front to the back.
struct NeckRing {
  double frontY, frontZ, backY, backZ, halfWidth;
};
constexpr std::array<NeckRing, 3> neckRings{{{-12.3, 3.2, -6.9, -7.7, 4.8},
                                             {-14.0, 2.5, -10.6, -7.6, 4.8},
                                             {-16.0, 2.8, -14.6, -8.2, 5.8}}};
inline std::vector<Vec3> neckPoints(const NeckRing& ring, int count) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    const double angle = std::numbers::pi * k / (count - 1), t = (1 - std::cos(angle)) / 2;
    const double x = k == 0 || k == count - 1 ? 0 : ring.halfWidth * std::sin(angle);
    points.push_back(
        {x, std::lerp(ring.frontY, ring.backY, t), std::lerp(ring.frontZ, ring.backZ, t)});
  }
  return points;
}

/// Draws the neck, which hangs from the throat, the ear lobe and the hollow.
inline void drawNeck(Sketch& sketch, Head& head) {
  head.ear.push_back(sketch.add(earRoot(earAngle(rowCount)), {Part::head, rowCount, kEar}, "lobe"));
  Line above = head.rows[throat];
  above.push_back(head.ear.back());
  above.insert(above.end(), head.rows[hollow].rbegin(), head.rows[hollow].rend());
  for (int r = 0; r <= static_cast<int>(neckRings.size()); ++r) {
    const auto points =
        r == 0 ? underJaw() : neckPoints(neckRings[r - 1], static_cast<int>(above.size()));
    Line ring;
    for (int k = 0; k < static_cast<int>(points.size()); ++k)
      ring.push_back(sketch.add(points[k], {Part::neck, r, k}, fmt::format("neck {}.{}", r, k)));
    sketch.strip(ring, above, "skin");
    above = ring;
  }
}

}  // namespace sample
