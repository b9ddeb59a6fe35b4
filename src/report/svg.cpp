#include "report/svg.hpp"

#include <array>
#include <fmt/format.h>

#include "report/html.hpp"

namespace sweepface::svg {

std::string text(double x, double y, std::string_view anchor, std::string_view content,
                 std::string_view colour, std::string_view more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n",
                     x, y, anchor, colour, more, html::escaped(content));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view colour,
                 std::string_view more) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"{}/>\n", x1, y1,
      x2, y2, colour, more);
}

std::string dot(double x, double y, std::string_view colour, double radius) {
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x, y, radius,
                     colour);
}

std::string framed(double width, double height, const std::string& title, const std::string& body) {
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\" "
      "xmlns=\"http://www.w3.org/2000/svg\">\n{}</svg>\n",
      width, height, html::escaped(title), body);
}

std::string_view dashes(const Series& series) {
  static constexpr std::array<std::string_view, kDashes> kPatterns{"", " stroke-dasharray=\"5 4\"",
                                                                   " stroke-dasharray=\"2 3\"",
                                                                   " stroke-dasharray=\"9 3 2 3\""};
  return kPatterns[static_cast<std::size_t>(series.dashes)];
}

// Most letters of three or more bytes are as wide as two.
double letters(std::string_view text) {
  double sum = 0;
  for (const char c : text)
    if ((c & 0xc0) != 0x80) sum += (c & 0xe0) == 0xe0 ? 2 : 1;
  return sum;
}

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

namespace {

constexpr double kKeyLetters = 44;

double widthOf(const std::string& key) { return 40 + 8 * letters(key); }  // for wide letters

}  // namespace

double addKeys(std::string& drawn, const std::vector<Series>& series, double x, double y,
               double right) {
  const double left = x;
  for (const Series& s : series) {
    const std::string key = shortened(s.name, kKeyLetters);
    if (x > left && x + widthOf(key) > right) x = left, y += 18;
    drawn += s.dots ? dot(x + 10, y - 4, s.colour)
                    : line(x, y - 4, x + 20, y - 4, s.colour,
                           fmt::format(" stroke-width=\"2\"{}", dashes(s)));
    drawn += text(x + 26, y, "start", key, kInk);
    x += widthOf(key);
  }
  return y;
}

}  // namespace sweepface::svg
