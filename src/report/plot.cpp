#include "sweepface/plot.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "report/colours.hpp"
#include "report/html.hpp"

namespace sweepface {
namespace {

/// The values of a direction and where they lie in the picture.
struct Scale {
  std::vector<double> ticks;
  bool logarithmic = false;
  double start = 0, end = 1;  ///< in the picture

  double at(double value) const {
    const auto place = [&](double v) { return logarithmic ? std::log(v) : v; };
    const double low = place(ticks.front()), high = place(ticks.back());
    return std::lerp(start, end, (place(value) - low) / (high - low));
  }
};

Scale scaleOf(const std::vector<Series>& series, double Vec2::* along, const Axis& axis,
              double start, double end) {
  double low = 1e300, high = -1e300;
  for (const Series& s : series)
    for (const Vec2& p : s.points) {
      low = std::min(low, p.*along);
      high = std::max(high, p.*along);
    }
  // Lengths start at 0, if that is not far away.
  if (!axis.logarithmic && low > 0 && low < 0.5 * high) low = 0;
  return {niceTicks(low, high, axis.logarithmic), axis.logarithmic, start, end};
}

std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view colour = kSoft, std::string_view more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n",
                     x, y, anchor, colour, more, html::escaped(content));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view colour,
                 std::string_view more = "") {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"{}/>\n", x1, y1,
      x2, y2, colour, more);
}

std::string dot(double x, double y, std::string_view colour, double radius = 3.5) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, radius,
                     colour);
}

std::string_view dashes(const Series& s) { return s.dashed ? " stroke-dasharray=\"5 4\"" : ""; }

/// Of a text in UTF-8, where bytes 10xxxxxx go on with a letter.
double letters(std::string_view text) {
  return static_cast<double>(
      std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

/// At most so many letters.
std::string shortened(const std::string& name, std::size_t most) {
  if (name.size() <= most) return name;
  std::size_t end = most - 1;
  while (end > 0 && (name[end] & 0xc0) == 0x80) --end;  // not in the middle of a letter
  return name.substr(0, end) + "…";
}

/// As short as it can be, without an exponent for the sizes of ordinary things.
std::string tickText(double value) {
  return std::abs(value) >= 1e4 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                         : fmt::format("{:.4g}", value);
}

double widthOf(const Series& key) { return 40 + 8 * letters(key.name); }  // of wide letters

/// The keys of a plot in lines from `x` to `right`, the first at `y`; returns where the last is.
double addKeys(std::string& svg, const std::vector<Series>& series, double x, double y,
               double right) {
  const double left = x;
  for (const Series& s : series) {
    if (x > left && x + widthOf(s) > right) x = left, y += 18;
    svg += s.dots ? dot(x + 10, y - 4, s.colour)
                  : line(x, y - 4, x + 20, y - 4, s.colour,
                         fmt::format(" stroke-width=\"2\"{}", dashes(s)));
    svg += text(x + 26, y, "start", s.name, kInk);
    x += widthOf(s);
  }
  return y;
}

std::string framed(double width, double height, const std::string& title, const std::string& body) {
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
      "xmlns=\"http://www.w3.org/2000/svg\">\n{}</svg>\n",
      width, height, html::escaped(title), body);
}

// Powers of ten, seven intervals at most.
std::vector<double> decadeTicks(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9)),
            last = static_cast<int>(std::ceil(std::log10(high) - 1e-9)),
            step = (last - first + 6) / 7;
  std::vector<double> ticks;
  for (int decade = first; decade < last + step; decade += step)
    ticks.push_back(std::pow(10, decade));
  return ticks;
}

}  // namespace

std::vector<double> niceTicks(double low, double high, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    if (!(low > 0) || !(high >= low) || !std::isfinite(high)) return {1, 10};
    if (high > 1e3 * low) return decadeTicks(low, high);
    for (int decade = static_cast<int>(std::floor(std::log10(low)));; ++decade)
      for (const double step : {1.0, 2.0, 5.0}) {
        const double tick = step * std::pow(10, decade);
        // The last one that is not above the smallest value, and all after it.
        if (tick <= low * (1 + 1e-9)) ticks.clear();
        ticks.push_back(tick);
        if (tick >= high * (1 - 1e-9) && ticks.size() > 1) return ticks;
      }
  }
  // What differs by no more than rounding is the same: steps as small could not be counted.
  if (!(high - low > 1e-12 * std::max(std::abs(low), std::abs(high))))
    high = low + (low != 0 ? std::abs(low) : 1);
  if (!std::isfinite(high - low) || high - low < 1e-300) return {0, 1};
  const double decade = std::pow(10, std::floor(std::log10((high - low) / 5)));
  double step = 10 * decade;
  for (const double nice : {5.0, 2.0, 1.0})
    if ((high - low) / (nice * decade) <= 7) step = nice * decade;
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  const int steps = static_cast<int>(last - first);
  for (int k = 0; k <= steps; ++k) ticks.push_back((first + k) * step);
  return ticks;
}

std::string linePlot(const std::string& title, const Axis& x, const Axis& y,
                     std::vector<Series> series) {
  constexpr double width = 490, height = 330, left = 70, right = 462, bottom = 278;
  for (Series& s : series)
    std::erase_if(s.points, [&](const Vec2& p) {
      return (x.logarithmic && !(p.x > 0)) || (y.logarithmic && !(p.y > 0));
    });
  if (std::ranges::all_of(series, [](const Series& s) { return s.points.empty(); })) return {};
  std::string svg = text(left, 18, "start", title, kInk, " font-weight=\"600\"");
  const double top = addKeys(svg, series, left, 39, width) + 13;
  const Scale across = scaleOf(series, &Vec2::x, x, left, right);
  const Scale up = scaleOf(series, &Vec2::y, y, bottom, top);
  for (const double tick : up.ticks) {
    svg += line(left, up.at(tick), right, up.at(tick), kGrid);
    svg += text(left - 8, up.at(tick) + 4, "end", tickText(tick));
  }
  for (const double tick : across.ticks) {
    svg += line(across.at(tick), bottom, across.at(tick), bottom + 5, kSoft);
    svg += text(across.at(tick), bottom + 20, "middle", tickText(tick));
  }
  svg += line(left, bottom, right, bottom, kSoft);
  svg += text(0.5 * (left + right), bottom + 42, "middle", x.title);
  svg += text(12, 0.5 * (top + bottom), "middle", y.title, kSoft,
              fmt::format(" transform=\"rotate(-90 12 {})\"", 0.5 * (top + bottom)));
  for (const Series& s : series) {
    std::string points;
    for (const Vec2& p : s.points)
      points += fmt::format("{:.1f},{:.1f} ", across.at(p.x), up.at(p.y));
    svg +=
        fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                    points, s.colour, dashes(s));
    if (s.dots)
      for (const Vec2& p : s.points) svg += dot(across.at(p.x), up.at(p.y), s.colour);
  }
  return framed(width, height, title, svg);
}

std::string plotSheet(const std::vector<std::string>& plots) {
  constexpr int width = 490, height = 330, gap = 20;
  const int rows = (static_cast<int>(plots.size()) + 1) / 2;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"system-ui, sans-serif\" font-size=\"13\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      2 * width + 3 * gap, rows * (height + gap) + gap);
  for (std::size_t k = 0; k < plots.size(); ++k)
    svg += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}",
                       gap + (k % 2) * (width + gap), gap + (k / 2) * (height + gap), width, height,
                       plots[k].substr(std::string_view("<svg ").size()));
  return svg + "</svg>\n";
}

std::string rowPlot(const std::string& title, const std::string& axis,
                    const std::vector<std::string>& names, const std::vector<Series>& series,
                    double limit) {
  constexpr double width = 640, row = 19, top = 62, right = 620;
  std::size_t longest = 4;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  constexpr std::size_t most = 36;
  const double left = 16 + 7.6 * static_cast<double>(std::min(longest, most));
  const double bottom = top + row * static_cast<double>(names.size());
  double high = limit;
  for (const Series& s : series)
    for (const Vec2& p : s.points) high = std::max(high, p.x);
  const Scale across{niceTicks(0, high, false), false, left, right};
  std::string svg = text(0, 18, "start", title, kInk, " font-weight=\"600\"");
  addKeys(svg, series, 0, 42, right);
  for (const double tick : across.ticks) {
    svg += line(across.at(tick), top, across.at(tick), bottom, kGrid);
    svg += text(across.at(tick), bottom + 18, "middle", tickText(tick));
  }
  if (limit > 0)
    svg += line(across.at(limit), top - 6, across.at(limit), bottom, kInk,
                " stroke-dasharray=\"5 4\"");
  svg += text(0.5 * (left + right), bottom + 38, "middle", axis);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double y = top + row * (static_cast<double>(k) + 0.5);
    svg += text(left - 10, y + 4, "end", shortened(names[k], most), kInk, " font-size=\"12\"");
    svg += line(left, y, right, y, "#efedea");
    for (const Series& s : series)
      if (k < s.points.size()) svg += dot(across.at(s.points[k].x), y, s.colour, 4);
  }
  return framed(width, bottom + 46, title, svg);
}

}  // namespace sweepface
