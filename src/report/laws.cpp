#include "sweepface/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "report/colours.hpp"
#include "report/html.hpp"

namespace sweepface {
namespace {

// A cell: a plot over the first second and a half, and a track below it.
constexpr double kWidth = 232, kHeight = 226, kLeft = 14, kRight = 218, kTop = 44, kBottom = 172,
                 kTrack = 196;
constexpr int kColumns = 4;
constexpr double kShown = 1.5, kLoop = 2.5;  // seconds
constexpr int kFrames = 60;

ShownLaw shown(std::string name, std::string use, const Result<Trajectory>& path) {
  return {std::move(name), std::move(use), path.value_or(Trajectory(1))};
}

double across(double time) { return kLeft + (kRight - kLeft) * time / kShown; }

/// Curves share the plot; each has a scale of its own.
struct Curve {
  std::string_view colour;
  double Kinematics::* value;
  double width;
};
constexpr std::array kCurves{Curve{kRed, &Kinematics::acceleration, 1.2},
                             Curve{kGreen, &Kinematics::velocity, 1.2},
                             Curve{kBlue, &Kinematics::position, 2.4}};

double place(double share) { return 136 - 64 * share; }

std::string curve(const Trajectory& path, const Curve& c) {
  constexpr int samples = 120;
  // Half as much room below the line as above.
  double largest = 1e-12;
  for (int k = 0; k <= samples; ++k) {
    const double value = path.at(kShown * k / samples).*c.value;
    largest = std::max(largest, value > 0 ? value : -2 * value);
  }
  const double scale = c.value == &Kinematics::position ? 1 : 0.9 / largest;
  std::string points;
  for (int k = 0; k <= samples; ++k) {
    const double time = kShown * k / samples;
    points += fmt::format("{:.1f},{:.1f} ", across(time), place(scale * (path.at(time).*c.value)));
  }
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
                     points, c.colour, c.width);
}

/// An animated attribute that runs through these values in a loop.
std::string moving(std::string_view attribute, const Trajectory& path, auto value) {
  std::string values;
  for (int k = 0; k <= kFrames; ++k) {
    const double time = kLoop * k / kFrames;
    values += fmt::format("{}{:.1f}", k ? ";" : "", value(time, path.at(time).position));
  }
  return fmt::format(
      "<animate attributeName=\"{}\" dur=\"{}s\" repeatCount=\"indefinite\" values=\"{}\"/>",
      attribute, kLoop, values);
}

std::string ball(std::string_view attributes, const std::string& movements) {
  return fmt::format("<circle class=\"moving\" {}>{}</circle>\n", attributes, movements);
}

std::string cell(const ShownLaw& law, double x, double y) {
  std::string html = fmt::format("<g transform=\"translate({} {})\">\n", x, y);
  html += fmt::format("<text x=\"{}\" y=\"20\" fill=\"{}\" font-weight=\"bold\">{}</text>\n", kLeft,
                      kInk, html::escaped(law.name));
  html += fmt::format("<text x=\"{}\" y=\"36\" fill=\"{}\">{}</text>\n", kLeft, kSoft,
                      html::escaped(law.use));
  for (const double share : {0.0, 1.0})
    html += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
                        kLeft, kRight, place(share), place(share), kGrid);
  html += fmt::format(
      "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"{3}\" "
      "stroke-dasharray=\"3 3\"/>\n",
      across(1), kTop, kBottom, kGrid);
  for (const Curve& c : kCurves) html += curve(law.path, c);
  html += ball(fmt::format("r=\"4\" fill=\"{}\"", kBlue),
               moving("cx", law.path, [](double t, double) {
                 return across(std::min(t, kShown));
               }) + moving("cy", law.path, [](double, double q) { return place(q); }));
  html += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\"/>\n", kLeft + 24,
                      kRight - 44, kTrack, kTrack, kGrid);
  html += ball(fmt::format("r=\"8\" cy=\"{}\" fill=\"{}\"", kTrack, kInk),
               moving("cx", law.path,
                      [](double, double q) { return std::lerp(kLeft + 24, kRight - 44, q); }));
  return html + "</g>\n";
}

}  // namespace

std::vector<ShownLaw> everyLaw() {
  const Start rest;
  constexpr std::array periodic{Harmonic{0, 30}};
  return {
      shown("accelerate-brake", "from rest to rest; when in doubt",
            Trajectory::twoForces(rest, 1, 1)),
      shown("linear-force", "from rest to rest, softer still", Trajectory::linearForce(rest, 1, 1)),
      shown("newton", "from rest into the next move", Trajectory::byLaw(TimeLaw::newton, 0, 1, 1)),
      shown("brake", "the move that follows newton", Trajectory::byLaw(TimeLaw::brake, 0, 1, 1)),
      shown("spring", "goals that keep changing", Trajectory::spring(rest, 1, {1.5, 1})),
      shown("spring, damping 0.3", "soft parts that swing on",
            Trajectory::spring(rest, 1, {1.5, 0.3})),
      shown("bounce", "lids and jaws that fall shut", Trajectory::bounce(rest, 1, 0.7, 0.5)),
      shown("linear", "timed elsewhere; for comparison",
            Trajectory::byLaw(TimeLaw::linear, 0, 1, 1)),
      shown("impulse", "a twitch, a nod; drag stops it", Trajectory::impulse(rest, 5, 5)),
      shown("periodic force", "shivers, breath, chewing",
            Trajectory::periodicForce(rest, 1, 1, 1 / 3.0, periodic)),
  };
}

std::string lawSheet() {
  const std::vector<ShownLaw> laws = everyLaw();
  const auto count = static_cast<int>(laws.size());
  const int rows = (count + kColumns - 1) / kColumns;
  std::string html = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      kColumns * kWidth, rows * kHeight + 24);
  for (int k = 0; k < count; ++k)
    html += cell(laws[static_cast<std::size_t>(k)], k % kColumns * kWidth, k / kColumns * kHeight);
  html += fmt::format(
      "<text x=\"{}\" y=\"{}\" fill=\"{}\">blue: position, green: velocity, red: force, each to "
      "its "
      "own scale, over one and a half seconds</text>\n",
      kLeft, rows * kHeight + 12, kSoft);
  return html + "</svg>\n";
}

}  // namespace sweepface
