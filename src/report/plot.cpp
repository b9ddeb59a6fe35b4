#include "sweepface/plot.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <span>

#include "report/scale.hpp"
#include "report/svg.hpp"

namespace sweepface {
namespace {

constexpr double kPlotWidth = 490;  // of linePlot()

Scale scaleOf(const std::vector<Series>& series, double Vec2::* along, const Axis& axis) {
  double low = 1e300, high = -1e300;
  for (const Series& s : series)
    for (const Vec2& p : s.points) {
      low = std::min(low, p.*along);
      high = std::max(high, p.*along);
    }
  // Linear scales start at 0 if that is not far away, and start or end there if the values hardly
  // change, or only by rounding.
  constexpr double kHardly = 1e-4;
  if (!axis.logarithmic && low > 0 && (low < 0.5 * high || high - low < kHardly * high)) low = 0;
  if (!axis.logarithmic && high < 0 && high - low < kHardly * -low) high = 0;
  return {niceTicks(low, high, axis.logarithmic), axis.logarithmic};
}

/// The lines and numbers round a plot, placed by its scales.
std::string axes(const Scale& across, const Scale& up, const Axis& x, const Axis& y) {
  const double left = across.start, right = across.end, bottom = up.start;
  std::string drawn;
  const std::vector<std::string> heights = labelsOf(up), places = labelsOf(across);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double height = up.at(up.ticks[k]);
    drawn += svg::line(left, height, right, height, kGrid);
    drawn += svg::text(left - 8, height + 4, "end", heights[k]);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double place = across.at(across.ticks[k]);
    drawn += svg::line(place, bottom, place, bottom + 5, kSoft);
    drawn += svg::text(place, bottom + 20, "middle", places[k]);
  }
  drawn += svg::line(left, bottom, right, bottom, kSoft);
  drawn += svg::text(0.5 * (left + right), bottom + 42, "middle", x.title);
  const double middle = 0.5 * (bottom + up.end);
  return drawn + svg::text(12, middle, "middle", y.title, kSoft,
                           fmt::format(" transform=\"rotate(-90 12 {})\"", middle));
}

std::string curve(const Series& series, const Scale& across, const Scale& up) {
  std::string points;
  for (const Vec2& p : series.points)
    points += fmt::format("{:.1f},{:.1f} ", across.at(p.x), up.at(p.y));
  std::string drawn = fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
      "stroke-linejoin=\"round\"{}/>\n",
      points, series.colour, svg::dashes(series));
  if (series.dots || series.points.size() == 1)
    for (const Vec2& p : series.points)
      drawn += svg::dot(across.at(p.x), up.at(p.y), series.colour);
  return drawn;
}

}  // namespace

std::string linePlot(const std::string& title, const Axis& x, const Axis& y,
                     std::vector<Series> series) {
  for (Series& s : series)
    std::erase_if(s.points, [&](const Vec2& p) {
      return !std::isfinite(p.x) || !std::isfinite(p.y) || (x.logarithmic && !(p.x > 0)) ||
             (y.logarithmic && !(p.y > 0));
    });
  if (std::ranges::all_of(series, [](const Series& s) { return s.points.empty(); })) return {};
  Scale across = scaleOf(series, &Vec2::x, x), up = scaleOf(series, &Vec2::y, y);
  across.start = 70, across.end = 462;
  for (const std::string& label : labelsOf(up))
    across.start = std::max(across.start, 28 + 7.5 * svg::letters(label));
  std::string drawn = svg::text(across.start, 18, "start", title, kInk, " font-weight=\"600\"");
  up.end = svg::addKeys(drawn, series, across.start, 39, kPlotWidth) + 13;
  up.start = std::max(278.0, up.end + 150);  // below however many lines of keys
  drawn += axes(across, up, x, y);
  for (const Series& s : series) drawn += curve(s, across, up);
  return svg::framed(kPlotWidth, up.start + 52, title, drawn);
}

namespace {

/// The height of a plot made by svg::framed().
double heightOf(std::string_view plot) {
  const std::string before = fmt::format("viewBox=\"0 0 {} ", kPlotWidth);
  double height = 0;
  std::from_chars(plot.data() + plot.find(before) + before.size(), plot.data() + plot.size(),
                  height);
  return height;
}

}  // namespace

std::string plotSheet(std::vector<std::string> plots) {
  std::erase(plots, "");
  constexpr double gap = 20;
  double y = gap;
  std::string drawn;
  for (std::size_t k = 0; k < plots.size(); k += 2) {
    const std::span row(plots.data() + k, std::min<std::size_t>(2, plots.size() - k));
    double x = gap, highest = 0;
    for (const std::string& plot : row) {
      drawn += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}", x, y, kPlotWidth,
                           heightOf(plot), plot.substr(std::string_view("<svg ").size()));
      x += kPlotWidth + gap;
      highest = std::max(highest, heightOf(plot));
    }
    y += highest + gap;
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"system-ui, sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg>\n",
      2 * kPlotWidth + 3 * gap, y, drawn);
}

}  // namespace sweepface
