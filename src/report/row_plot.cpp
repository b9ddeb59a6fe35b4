#include <algorithm>
#include <cmath>

#include "report/scale.hpp"
#include "report/svg.hpp"

namespace sweepface {

std::string rowPlot(const std::string& title, const std::string& axis,
                    const std::vector<std::string>& names, const std::vector<Series>& series,
                    double limit) {
  constexpr double width = 640, row = 19, top = 62, right = 600, most = 36;
  double longest = 4;
  for (const std::string& name : names) longest = std::max(longest, svg::letters(name));
  const double left = 16 + 7.6 * std::min(longest, most);
  const double bottom = top + row * static_cast<double>(names.size());
  double high = limit;
  for (const Series& s : series)
    for (const Vec2& p : s.points) high = std::max(high, p.x);
  const Scale across{niceTicks(0, high, false), false, left, right};
  std::string drawn = svg::text(0, 18, "start", title, kInk, " font-weight=\"600\"");
  svg::addKeys(drawn, series, 0, 42, right);
  const std::vector<std::string> labels = labelsOf(across);
  double widest = 0;
  for (const std::string& label : labels) widest = std::max(widest, 8 * svg::letters(label) + 8);
  const double space = (right - left) / static_cast<double>(labels.size() - 1);
  const auto every = static_cast<std::size_t>(std::ceil(widest / space));  // so that none overlap
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const double place = across.at(across.ticks[k]);
    drawn += svg::line(place, top, place, bottom, kGrid);
    if (k % every == 0) drawn += svg::text(place, bottom + 18, "middle", labels[k]);
  }
  if (limit > 0)
    drawn += svg::line(across.at(limit), top - 6, across.at(limit), bottom, kInk,
                       " stroke-dasharray=\"5 4\"");
  drawn += svg::text(0.5 * (left + right), bottom + 38, "middle", axis);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double y = top + row * (static_cast<double>(k) + 0.5);
    drawn += svg::text(left - 10, y + 4, "end", svg::shortened(names[k], most), kInk,
                       " font-size=\"12\"");
    drawn += svg::line(left, y, right, y, "#efedea");
    for (const Series& s : series)
      if (k < s.points.size()) drawn += svg::dot(across.at(s.points[k].x), y, s.colour, 4);
  }
  return svg::framed(width, bottom + 46, title, drawn);
}

}  // namespace sweepface
