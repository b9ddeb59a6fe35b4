#include "sweepface/plot.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <span>

#include "report/colours.hpp"
#include "report/html.hpp"

namespace sweepface {
namespace {

constexpr double kPlotWidth = 490;  // of linePlot()

/// The values of a direction.
struct Scale {
  std::vector<double> ticks;
  bool logarithmic = false;
  double start = 0, end = 1;  ///< where they lie in the picture

  double at(double value) const {
    const auto place = [&](double v) { return logarithmic ? std::log(v) : v; };
    const double low = place(ticks.front()), high = place(ticks.back());
    return std::lerp(start, end, (place(value) - low) / (high - low));
  }
};

/// Whether numbers differ by no more than rounding: steps as small could not be counted.
bool isSame(double low, double high) {
  return !(high - low > 1e-12 * std::max(std::abs(low), std::abs(high)));
}

Scale scaleOf(const std::vector<Series>& series, double Vec2::* along, const Axis& axis) {
  double low = 1e300, high = -1e300;
  for (const Series& s : series)
    for (const Vec2& p : s.points) {
      low = std::min(low, p.*along);
      high = std::max(high, p.*along);
    }
  // Lengths start at 0, if that is not far away, and so does what never changes.
  if (!axis.logarithmic && low > 0 && (low < 0.5 * high || isSame(low, high))) low = 0;
  return {niceTicks(low, high, axis.logarithmic), axis.logarithmic};
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

std::string_view dashes(const Series& s) {
  static constexpr std::array<std::string_view, kDashes> kPatterns{"", " stroke-dasharray=\"5 4\"",
                                                                   " stroke-dasharray=\"2 3\"",
                                                                   " stroke-dasharray=\"9 3 2 3\""};
  return kPatterns[static_cast<std::size_t>(s.dashes)];
}

/// How wide a text in UTF-8 is, in Latin letters; most letters of three bytes and more are as wide
/// as two.
double letters(std::string_view text) {
  double sum = 0;
  for (const char c : text)
    if ((c & 0xc0) != 0x80) sum += (c & 0xe0) == 0xe0 ? 2 : 1;
  return sum;
}

/// As wide as so many letters at most: the middle goes, since names often begin or end alike.
std::string shortened(const std::string& name, double most) {
  if (letters(name) <= most) return name;
  const auto isInside = [&](std::size_t at) {
    return at > 0 && at < name.size() && (name[at] & 0xc0) == 0x80;
  };
  const std::string_view all = name;
  const auto fits = [&](std::string_view part) { return letters(part) <= (most - 1) / 2; };
  std::size_t head = 0, tail = name.size();
  for (std::size_t at = 0; isInside(at) || fits(all.substr(0, at)); ++at)
    if (!isInside(at)) head = at;
  for (std::size_t at = name.size(); isInside(at) || fits(all.substr(at)); --at)
    if (!isInside(at)) tail = at;
  return name.substr(0, head) + "…" + name.substr(tail);
}

/// As short as they can be and still differ, without an exponent for the sizes of ordinary things.
std::vector<std::string> labelsOf(const Scale& scale) {
  const std::vector<double>& ticks = scale.ticks;
  const double most = std::max(std::abs(ticks.front()), std::abs(ticks.back())),
               step = ticks[1] - ticks[0];
  const double digits =
      scale.logarithmic ? 1 : std::floor(std::log10(most)) - std::floor(std::log10(step)) + 1;
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    const double fewest = std::abs(tick) >= 1e4 && std::abs(tick) < 1e7 ? 7 : 4;
    labels.push_back(
        fmt::format("{:.{}g}", tick, static_cast<int>(std::clamp(digits, fewest, 15.0))));
  }
  return labels;
}

constexpr double kKeyLetters = 44;

double widthOf(const std::string& key) { return 40 + 8 * letters(key); }  // of wide letters

/// The keys of a plot in lines from `x` to `right`, the first at `y`; returns where the last is.
double addKeys(std::string& svg, const std::vector<Series>& series, double x, double y,
               double right) {
  const double left = x;
  for (const Series& s : series) {
    const std::string key = shortened(s.name, kKeyLetters);
    if (x > left && x + widthOf(key) > right) x = left, y += 18;
    svg += s.dots ? dot(x + 10, y - 4, s.colour)
                  : line(x, y - 4, x + 20, y - 4, s.colour,
                         fmt::format(" stroke-width=\"2\"{}", dashes(s)));
    svg += text(x + 26, y, "start", key, kInk);
    x += widthOf(key);
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
  if (isSame(low, high)) high = low + (low != 0 ? std::abs(low) : 1);
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

namespace {

/// The lines and numbers round a plot, whose scales say where they lie.
std::string axes(const Scale& across, const Scale& up, const Axis& x, const Axis& y) {
  const double left = across.start, right = across.end, bottom = up.start;
  std::string svg;
  const std::vector<std::string> heights = labelsOf(up), places = labelsOf(across);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const double height = up.at(up.ticks[k]);
    svg += line(left, height, right, height, kGrid);
    svg += text(left - 8, height + 4, "end", heights[k]);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double place = across.at(across.ticks[k]);
    svg += line(place, bottom, place, bottom + 5, kSoft);
    svg += text(place, bottom + 20, "middle", places[k]);
  }
  svg += line(left, bottom, right, bottom, kSoft);
  svg += text(0.5 * (left + right), bottom + 42, "middle", x.title);
  const double middle = 0.5 * (bottom + up.end);
  return svg + text(12, middle, "middle", y.title, kSoft,
                    fmt::format(" transform=\"rotate(-90 12 {})\"", middle));
}

std::string curve(const Series& series, const Scale& across, const Scale& up) {
  std::string points;
  for (const Vec2& p : series.points)
    points += fmt::format("{:.1f},{:.1f} ", across.at(p.x), up.at(p.y));
  std::string svg = fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
      "stroke-linejoin=\"round\"{}/>\n",
      points, series.colour, dashes(series));
  if (series.dots || series.points.size() == 1)
    for (const Vec2& p : series.points) svg += dot(across.at(p.x), up.at(p.y), series.colour);
  return svg;
}

}  // namespace

std::string linePlot(const std::string& title, const Axis& x, const Axis& y,
                     std::vector<Series> series) {
  for (Series& s : series)
    std::erase_if(s.points, [&](const Vec2& p) {
      return (x.logarithmic && !(p.x > 0)) || (y.logarithmic && !(p.y > 0));
    });
  if (std::ranges::all_of(series, [](const Series& s) { return s.points.empty(); })) return {};
  Scale across = scaleOf(series, &Vec2::x, x), up = scaleOf(series, &Vec2::y, y);
  across.start = 70, across.end = 462;
  for (const std::string& label : labelsOf(up))
    across.start = std::max(across.start, 28 + 7.5 * letters(label));
  std::string svg = text(across.start, 18, "start", title, kInk, " font-weight=\"600\"");
  up.end = addKeys(svg, series, across.start, 39, kPlotWidth) + 13;
  up.start = std::max(278.0, up.end + 150);  // below however many lines of keys
  svg += axes(across, up, x, y);
  for (const Series& s : series) svg += curve(s, across, up);
  return framed(kPlotWidth, up.start + 52, title, svg);
}

namespace {

/// Of what framed() made.
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
  std::string svg;
  for (std::size_t k = 0; k < plots.size(); k += 2) {
    const std::span row(plots.data() + k, std::min<std::size_t>(2, plots.size() - k));
    double x = gap, highest = 0;
    for (const std::string& plot : row) {
      svg += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}", x, y, kPlotWidth,
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
      2 * kPlotWidth + 3 * gap, y, svg);
}

std::string rowPlot(const std::string& title, const std::string& axis,
                    const std::vector<std::string>& names, const std::vector<Series>& series,
                    double limit) {
  constexpr double width = 640, row = 19, top = 62, right = 600, most = 36;
  double longest = 4;
  for (const std::string& name : names) longest = std::max(longest, letters(name));
  const double left = 16 + 7.6 * std::min(longest, most);
  const double bottom = top + row * static_cast<double>(names.size());
  double high = limit;
  for (const Series& s : series)
    for (const Vec2& p : s.points) high = std::max(high, p.x);
  const Scale across{niceTicks(0, high, false), false, left, right};
  std::string svg = text(0, 18, "start", title, kInk, " font-weight=\"600\"");
  addKeys(svg, series, 0, 42, right);
  const std::vector<std::string> labels = labelsOf(across);
  double widest = 0;
  for (const std::string& label : labels) widest = std::max(widest, 8 * letters(label) + 8);
  const double space = (right - left) / static_cast<double>(labels.size() - 1);
  const auto every = static_cast<std::size_t>(std::ceil(widest / space));  // so that none overlap
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const double place = across.at(across.ticks[k]);
    svg += line(place, top, place, bottom, kGrid);
    if (k % every == 0) svg += text(place, bottom + 18, "middle", labels[k]);
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
