#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/picture.hpp"

#include "picture/colour.hpp"
#include "picture/number.hpp"

namespace sweepface {
namespace {

constexpr Colour kInk{0.20f, 0.20f, 0.22f};

/// Height of capitals, in pixels, next to pictures of this size.
double textHeight(PictureSize panel) {
  return std::clamp(0.021 * std::min(panel.width, panel.height), 7.0, 40.0);
}
Index captionHeight(PictureSize panel) {
  return static_cast<Index>(std::lround(2.6 * textHeight(panel)));
}
Index footHeight(PictureSize panel) {
  return static_cast<Index>(std::lround(4.4 * textHeight(panel)));
}

/// Draws a text as large as fits the width, `height` at most, if it is then still readable.
void drawFitting(Image& image, std::string_view text, double x, double y, double height,
                 double width) {
  constexpr double kReadable = 4;  // height of capitals, pixels
  const double fitting = std::min(height, height * width / std::max(textWidth(text, height), 1.0));
  if (fitting >= kReadable) drawText(image, text, x, y, fitting, kInk, Align::centre);
}

}  // namespace

PictureSize Page::sizeFor(PictureSize panel, const Plan& plan) {
  const Index row = panel.height + (plan.captions ? captionHeight(panel) : 0);
  return {plan.columns * panel.width, plan.rows * row + (plan.foot ? footHeight(panel) : 0)};
}

Result<Page> Page::make(PictureSize size, const Plan& plan) {
  if (auto ok = checkSize(size); !ok) return std::unexpected(ok.error());
  if (plan.columns < 1 || plan.rows < 1)
    return fail("A page has at least one column and one row of pictures.");
  // The size of the text depends on that of the pictures, which get the room that the text leaves.
  PictureSize panel{size.width / plan.columns, size.height / plan.rows};
  while (panel.height > 0 && sizeFor(panel, plan).height > size.height) --panel.height;
  if (!checkSize(panel))
    return fail(fmt::format(
        "A page of {} × {} pixels has no room for {} × {} pictures; give a larger size.",
        size.width, size.height, plan.columns, plan.rows));
  Page page;
  page.plan_ = plan;
  page.panel_ = panel;
  page.image_ = Image::filled(size, kPaper);
  return page;
}

void Page::place(Index column, Index row, const Image& image, std::string_view caption) {
  const Index height = panel_.height + (plan_.captions ? captionHeight(panel_) : 0);
  const Index x = column * panel_.width, y = row * height;
  paste(image_, image, x, y);
  // Keeps pictures that fill their panels from running together.
  const Index gap = std::max<Index>(2, panel_.width / 150);
  for (const Index side : {column, column + 1})
    if (side > 0 && side < plan_.columns)
      fillRectangle(image_, side * panel_.width - gap / 2, y, gap, panel_.height, kPaper);
  const double text = textHeight(panel_);
  drawFitting(image_, caption, x + 0.5 * panel_.width, y + panel_.height + 1.6 * text, text,
              0.94 * panel_.width);
}

void Page::addLegend(std::span<const Key> keys) {
  double text = textHeight(panel_);
  const auto widthOf = [&] {
    double width = 0;
    for (const Key& key : keys) width += 3 * text + textWidth(key.text, text) + 2 * text;
    return width - 2 * text;
  };
  const double room = 0.94 * image_.width;
  if (const double width = widthOf(); width > room) text *= room / width;
  double x = 0.5 * (image_.width - widthOf());
  const double y = image_.height - 1.7 * textHeight(panel_);
  for (const Key& key : keys) {
    const std::array line{Vec2{x, y - 0.5 * text}, Vec2{x + 2.2 * text, y - 0.5 * text}};
    drawLine(image_, line, 0.36 * text, key.colour);
    drawText(image_, key.text, x + 3 * text, y, text, kInk);
    x += 5 * text + textWidth(key.text, text);
  }
}

void Page::addScale(double top, std::string_view title) {
  const double text = textHeight(panel_);
  // Whole pixels, so that the colours of the bar are exactly those of the map.
  const double width = std::floor(std::min(0.7 * image_.width, 34 * text));
  const double left = std::floor(0.5 * (image_.width - width)), height = std::round(text);
  const double bar = std::round(image_.height - footHeight(panel_) + 1.5 * text);
  const auto steps = static_cast<int>(width);
  for (int k = 0; k < steps; ++k)
    fillRectangle(image_, left + k, bar, 1, height, heatColour((k + 0.5) / steps));
  drawFitting(image_, title, 0.5 * image_.width, bar - 0.6 * text, 0.85 * text,
              0.94 * image_.width);
  constexpr int ticks = 4;
  for (int k = 0; k <= ticks; ++k) {
    const double x = left + width * k / ticks;
    fillRectangle(image_, std::round(x - 0.5), bar + height, 1, 0.3 * text, kInk);
    drawText(image_, number(top * k / ticks), x, bar + 2.3 * text, 0.8 * text, kInk, Align::centre);
  }
}

}  // namespace sweepface
