#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/picture.hpp"

namespace sweepface {

Result<PictureBox> parseBox(std::string_view text) {
  std::array<double, 4> values{};
  const char *at = text.data(), *const end = at + text.size();
  bool sound = true;
  for (std::size_t k = 0; k < 4 && sound; ++k) {
    const auto [stop, error] = std::from_chars(at, end, values[k]);
    const bool last = k == 3;
    sound = error == std::errc{} && values[k] >= 0 && values[k] <= 1 &&
            (last ? stop == end : stop != end && *stop == ',');
    at = sound && !last ? stop + 1 : stop;
  }
  constexpr double kAll = 1 + 1e-9;  // sums of decimals are rounded
  if (sound && values[2] > 0 && values[3] > 0 && values[0] + values[2] <= kAll &&
      values[1] + values[3] <= kAll)
    return PictureBox{values[0], values[1], values[2], values[3]};
  return fail(fmt::format(
      "'{}' is no box in the picture; give X,Y,WIDTH,HEIGHT as shares of it from 0 to 1.", text));
}

PictureBox boxAround(std::span<const Vec3> points, const Camera& camera, PictureSize size) {
  constexpr double room = 0.015;
  double left = 1, right = 0, top = 1, bottom = 0;
  for (const Vec3& p : points) {
    const Vec3 seen = camera.project(p, size);
    left = std::min(left, seen.x / size.width);
    right = std::max(right, seen.x / size.width);
    top = std::min(top, seen.y / size.height);
    bottom = std::max(bottom, seen.y / size.height);
  }
  return {left - room, top - room, right - left + 2 * room, bottom - top + 2 * room};
}

void drawBoxes(Image& image, std::span<const PictureBox> boxes) {
  constexpr std::array<Colour, 4> colours{
      {{0.16f, 0.62f, 0.33f}, {0.15f, 0.40f, 0.82f}, {0.90f, 0.49f, 0.13f}, {0.55f, 0.30f, 0.70f}}};
  const double line = std::max(0.005 * image.height, 1.5);
  for (std::size_t k = 0; k < boxes.size(); ++k)
    drawRectangle(image, boxes[k].x * image.width, boxes[k].y * image.height,
                  boxes[k].width * image.width, boxes[k].height * image.height, line,
                  colours[k % colours.size()]);
}

}  // namespace sweepface
