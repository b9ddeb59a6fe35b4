#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/picture.hpp"

#include "picture/colour.hpp"
#include "picture/font.hpp"
#include "picture/mask.hpp"

namespace sweepface {
namespace {

constexpr Index kSmallest = 16, kLargest = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

/// The width of a letter's strokes, relative to the height of capitals.
constexpr double kWeight = 0.125;

}  // namespace

Result<void> checkSize(PictureSize size) {
  const auto fits = [](Index n) { return n >= kSmallest && n <= kLargest; };
  if (fits(size.width) && fits(size.height) &&
      std::int64_t{size.width} * size.height <= kMostPixels)
    return {};
  return fail(
      fmt::format("A picture of {} × {} pixels cannot be made; give {} to {} each way and no more "
                  "than {} million in all.",
                  size.width, size.height, kSmallest, kLargest, kMostPixels / 1'000'000));
}

Result<PictureSize> parseSize(std::string_view text) {
  PictureSize size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec == std::errc{} && height.ptr == end) {
      if (auto ok = checkSize(size); !ok) return std::unexpected(ok.error());
      return size;
    }
  }
  return fail(
      fmt::format("'{}' is no size of a picture; give WIDTHxHEIGHT, such as 1200x900.", text));
}

Image Image::filled(PictureSize size, const Colour& colour) {
  Image image{size.width, size.height, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(size.width) * size.height);
  for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
    image.rgb[k] = toByte(colour.r);
    image.rgb[k + 1] = toByte(colour.g);
    image.rgb[k + 2] = toByte(colour.b);
  }
  return image;
}

Colour Image::at(Index x, Index y) const {
  const std::uint8_t* const p = &rgb[3 * (static_cast<std::size_t>(y) * width + x)];
  return {p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f};
}

double textWidth(std::string_view text, double height) {
  double width = 0;
  for (const char32_t letter : codePoints(text)) width += glyphOf(letter).width + kLetterGap;
  return std::max(0.0, width - kLetterGap) * height / kCapitalHeight;
}

void drawText(Image& image, std::string_view text, double x, double y, double height,
              const Colour& colour, Align align) {
  const double scale = height / kCapitalHeight, width = textWidth(text, height);
  if (align == Align::centre) x -= width / 2;
  if (align == Align::right) x -= width;
  Mask mask(image, x - height, y - 1.5 * height, x + width + height, y + 0.8 * height);
  for (const char32_t letter : codePoints(text)) {
    const Glyph& glyph = glyphOf(letter);
    const auto place = [&](const Vec2& p) { return Vec2{x + scale * p.x, y - scale * p.y}; };
    for (const auto& line : glyph.lines) {
      const bool dot = line.size() == 2 && line[0] == line[1];
      for (std::size_t k = 1; k < line.size(); ++k)
        mask.addLine(place(line[k - 1]), place(line[k]), (dot ? 1.35 : 1) * kWeight * height);
    }
    x += scale * (glyph.width + kLetterGap);
  }
  mask.paint(image, colour);
}

void drawLine(Image& image, std::span<const Vec2> points, double width, const Colour& colour) {
  if (points.empty()) return;
  const auto [left, right] = std::ranges::minmax(points, {}, &Vec2::x);
  const auto [top, bottom] = std::ranges::minmax(points, {}, &Vec2::y);
  Mask mask(image, left.x - width, top.y - width, right.x + width, bottom.y + width);
  for (std::size_t k = 0; k < points.size(); ++k)
    mask.addLine(points[k == 0 ? 0 : k - 1], points[k], width);
  mask.paint(image, colour);
}

void fillRectangle(Image& image, double x, double y, double width, double height,
                   const Colour& colour) {
  Mask mask(image, x, y, x + width, y + height);
  mask.addRectangle(x, y, width, height);
  mask.paint(image, colour);
}

void drawRectangle(Image& image, double x, double y, double width, double height, double line,
                   const Colour& colour) {
  fillRectangle(image, x, y, width, line, colour);
  fillRectangle(image, x, y + height - line, width, line, colour);
  fillRectangle(image, x, y + line, line, height - 2 * line, colour);
  fillRectangle(image, x + width - line, y + line, line, height - 2 * line, colour);
}

void paste(Image& image, const Image& part, Index x, Index y) {
  const Index left = std::max(x, 0), right = std::min(x + part.width, image.width);
  if (left >= right) return;
  for (Index row = std::max(0, -y); row < std::min(part.height, image.height - y); ++row) {
    const auto from = part.rgb.begin() + 3 * (std::ptrdiff_t{row} * part.width + left - x);
    std::copy(from, from + 3 * (right - left),
              image.rgb.begin() + 3 * (std::ptrdiff_t{y + row} * image.width + left));
  }
}

}  // namespace sweepface
