#pragma once

#include <span>
#include <vector>

#include "sweepface/picture.hpp"

namespace sweepface {

/// The share of each pixel that a drawing covers. Where parts overlap, the larger share counts, so
/// that no joint shows.
class Mask {
 public:
  /// Covers the part of an image from (left, top) to (right, bottom), clipped to the image.
  Mask(const Image& image, double left, double top, double right, double bottom);
  /// Covers all of an image.
  explicit Mask(const Image& image);

  /// A line with round ends.
  void addLine(const Vec2& from, const Vec2& to, double width);
  void addRectangle(double x, double y, double width, double height);
  /// Colours the image through the mask.
  void paint(Image& image, const Colour& colour) const;

 private:
  void cover(Index x, Index y, double share);

  Index left_ = 0, top_ = 0, right_ = -1, bottom_ = -1;  // pixels, inclusive
  std::vector<std::uint8_t> share_;
};

}  // namespace sweepface
