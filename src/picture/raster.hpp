#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/picture.hpp"

namespace sweepface {

/// The samples of a pixel: sixteen places, no two in the same sixteenth of a column or row.
inline constexpr int kSamples = 16;
inline constexpr std::array<std::array<double, 2>, kSamples> kSamplePlaces = [] {
  constexpr int column[kSamples] = {8, 7, 5, 12, 3, 10, 13, 11, 6, 4, 1, 0, 9, 14, 15, 2};
  constexpr int row[kSamples] = {8, 4, 10, 7, 6, 13, 5, 2, 14, 1, 12, 9, 15, 11, 3, 0};
  std::array<std::array<double, 2>, kSamples> places{};
  for (int k = 0; k < kSamples; ++k)
    places[k] = {(column[k] + 0.5) / kSamples, (row[k] + 0.5) / kSamples};
  return places;
}();

/// What a sample sees.
struct Hit {
  Index triangle = -1;  ///< -1: none
  float depth = 0;      ///< 1 / distance
};

/// The side of a tile, the square of pixels that is processed at a time.
inline constexpr Index kTile = 32;

/// Triangles as a camera sees them, binned by tile.
class Raster {
 public:
  Raster(const Scene& scene, const Camera& camera, PictureSize size);

  Index tileCount() const { return columns_ * rows_; }
  Index tileX(Index tile) const { return tile % columns_ * kTile; }
  Index tileY(Index tile) const { return tile / columns_ * kTile; }

  /// The nearest triangle at each sample of a tile: [kTile × kTile × kSamples]. At equal distances
  /// the first in the scene wins.
  void look(Index tile, std::vector<Hit>& hits) const;

  struct Place {
    std::array<double, 3> weights;  ///< of the triangle's corners
    bool front;                     ///< whether its outer side is seen
  };
  /// The place in a triangle of a sample at (x, y).
  Place placeIn(Index triangle, double x, double y) const;

 private:
  struct Bounds {
    Index left, right, top, bottom;  ///< pixels, inclusive
  };
  /// Twice the area on the screen of the triangle a, b, (x, y).
  double side(Index a, Index b, double x, double y) const {
    const Vec3 &p = screen_[a], &q = screen_[b];
    return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
  }
  std::array<double, 3> sides(Index triangle, double x, double y) const {
    const auto& [a, b, c] = triangles_[triangle];
    return {side(b, c, x, y), side(c, a, x, y), side(a, b, x, y)};
  }
  Bounds boundsOf(Index triangle) const;

  std::span<const std::array<Index, 3>> triangles_;
  std::vector<Vec3> screen_;  // x, y in pixels, z = 1 / distance
  PictureSize size_;
  Index columns_, rows_;
  std::vector<Index> tileStart_, tileTriangles_;  // triangles of each tile, in the scene's order
};

}  // namespace sweepface
