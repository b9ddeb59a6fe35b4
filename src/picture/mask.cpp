#include "picture/mask.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "picture/colour.hpp"

namespace sweepface {
namespace {

/// The pixels from floor(low) to floor(high), clipped to [first, last].
std::pair<Index, Index> pixels(double low, double high, Index first, Index last) {
  const auto whole = [&](double x) {
    return static_cast<Index>(std::clamp(std::floor(x), first - 1.0, last + 1.0));
  };
  return {std::max(whole(low), first), std::min(whole(high), last)};
}

double distanceToLine(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double t =
      length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

bool isFinite(const Vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

Mask::Mask(const Image& image, double left, double top, double right, double bottom) {
  if (!isFinite(Vec2{left, top}) || !isFinite(Vec2{right, bottom})) return;
  std::tie(left_, right_) = pixels(left, right, 0, image.width - 1);
  std::tie(top_, bottom_) = pixels(top, bottom, 0, image.height - 1);
  if (left_ > right_ || top_ > bottom_) left_ = top_ = 0, right_ = bottom_ = -1;
  share_.assign(static_cast<std::size_t>(right_ - left_ + 1) * (bottom_ - top_ + 1), 0);
}

Mask::Mask(const Image& image) : Mask(image, 0, 0, image.width, image.height) {}

void Mask::cover(Index x, Index y, double share) {
  const auto row = static_cast<std::size_t>(right_ - left_ + 1);
  std::uint8_t& covered = share_[(y - top_) * row + (x - left_)];
  covered = std::max(covered, toByte(static_cast<float>(share)));
}

void Mask::addLine(const Vec2& from, const Vec2& to, double width) {
  if (!isFinite(from) || !isFinite(to) || !(width > 0)) return;
  // A line thinner than a pixel is drawn a pixel wide, but fainter.
  const double reach = std::max(width, 1.0) / 2 + 0.5, strength = std::min(width, 1.0);
  const auto [left, right] =
      pixels(std::min(from.x, to.x) - reach, std::max(from.x, to.x) + reach, left_, right_);
  const auto [top, bottom] =
      pixels(std::min(from.y, to.y) - reach, std::max(from.y, to.y) + reach, top_, bottom_);
  for (Index y = top; y <= bottom; ++y)
    for (Index x = left; x <= right; ++x) {
      const double share = reach - distanceToLine({x + 0.5, y + 0.5}, from, to);
      if (share > 0) cover(x, y, strength * std::min(share, 1.0));
    }
}

void Mask::addRectangle(double x, double y, double width, double height) {
  const auto [left, right] = pixels(x, x + width, left_, right_);
  const auto [top, bottom] = pixels(y, y + height, top_, bottom_);
  for (Index py = top; py <= bottom; ++py)
    for (Index px = left; px <= right; ++px) {
      const double w = std::min(x + width, px + 1.0) - std::max(x, 1.0 * px);
      const double h = std::min(y + height, py + 1.0) - std::max(y, 1.0 * py);
      if (w > 0 && h > 0) cover(px, py, w * h);
    }
}

void Mask::paint(Image& image, const Colour& colour) const {
  const std::uint8_t ink[3] = {toByte(colour.r), toByte(colour.g), toByte(colour.b)};
  const std::uint8_t* share = share_.data();
  for (Index y = top_; y <= bottom_; ++y)
    for (Index x = left_; x <= right_; ++x, ++share)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& paper = image.rgb[3 * (static_cast<std::size_t>(y) * image.width + x) + c];
        paper = static_cast<std::uint8_t>((paper * (255 - *share) + ink[c] * *share + 127) / 255);
      }
}

}  // namespace sweepface
