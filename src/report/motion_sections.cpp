#include "report/motion_sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/laws.hpp"
#include "sweepface/motion.hpp"
#include "sweepface/plot.hpp"

#include "report/words.hpp"

namespace sweepface {
namespace {

constexpr PictureSize kFrame{232, 290}, kSprite{150, 188};
constexpr int kKeyFrames = 31, kShownFrames = 6;
constexpr std::array kPaperLaws{TimeLaw::linear, TimeLaw::newton};

// The moving pictures show the nearest of these poses.
constexpr int kPoses = 25;
constexpr double kFurthest = 1.5;
constexpr double kSeconds = 2.5, kRate = 24;

double shareOfTime(int frame) { return static_cast<double>(frame) / (kKeyFrames - 1); }

Weights scaled(Weights weights, double by) {
  for (double& w : weights) w *= by;
  return weights;
}

int poseAt(double position) {
  const double pose = std::round(position / kFurthest * (kPoses - 1));
  return static_cast<int>(std::clamp(pose, 0.0, kPoses - 1.0));
}

/// The poses of a law, one after another, as a CSS animation.
std::string moves(std::size_t number, const Trajectory& path) {
  const int frames = static_cast<int>(kSeconds * kRate);
  std::string steps;
  int before = -1;
  for (int k = 0; k < frames; ++k) {
    const int pose = poseAt(path.at(k / kRate).position);
    if (pose == before) continue;
    steps += fmt::format("{:.2f}%{{background-position:-{}px 0}}", 100.0 * k / frames,
                         pose * kSprite.width);
    before = pose;
  }
  return fmt::format("@keyframes law{}{{{}}}\n", number, steps);
}

}  // namespace

std::string mixtureOf(const Rig& rig, const Weights& weights) {
  std::string text;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    if (!text.empty()) text += ", ";
    text += rig.targets[k].name;
    if (weights[k] != 1) text += "=" + number(weights[k]);
  }
  return text;
}

Weights strongestOf(const Rig& rig) {
  Weights weights(rig.targets.size(), 0.0);
  double most = 0;
  std::size_t best = weights.size();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    double sum = 0;
    for (Index v = 0; v < rig.surface.storedCount(); ++v)
      if (rig.surface.stored(v).isPosition())
        sum += dot(rig.targets[k].difference[v], rig.targets[k].difference[v]);
    if (sum > most) most = sum, best = k;
  }
  if (best < weights.size()) weights[best] = 1;
  return weights;
}

MotionSections::MotionSections(const Rig& rig, const Subject& subject, const FaceScenes& scenes,
                               const Weights& expression, std::span<const std::string> regions,
                               std::function<Result<void>()> drawing)
    : rig_(rig),
      scenes_(scenes),
      expression_(expression),
      front_(subject.cameras(scenes, expression, std::array{View{0, 0}})[0]),
      regions_(regions),
      drawing_(std::move(drawing)),
      fine_(rig, lodFor(rig.surface, Style::shaded, subject.cutFor(kFrame))),
      rest_(rig.targets.size(), 0.0) {}

int MotionSections::pictures() {
  return static_cast<int>(kPaperLaws.size()) * kShownFrames + kPoses;
}

Result<Image> MotionSections::picture(double way, PictureSize size) const {
  if (auto ok = drawing_(); !ok) return std::unexpected(ok.error());
  return render(fine_.scene(scaled(expression_, way), Style::shaded), front_, size);
}

// ---- The paper's experiment ----

Result<std::string> MotionSections::experiment() const {
  const Result<std::string> frames = strips();
  if (!frames) return std::unexpected(frames.error());
  return section("Linear and Newton",
                 fmt::format("The way from the neutral to {} in {} key frames, of which every "
                             "sixth is shown, counted from 0; the boxes stay where they are. "
                             "Linear interpolation goes the same way in every frame. Under "
                             "Newton's second law a constant force accelerates the face from "
                             "rest: its velocity grows evenly. The plots follow the point of the "
                             "face that goes furthest.",
                             mixtureOf(rig_, expression_), kKeyFrames)) +
         *frames + plots();
}

Result<std::string> MotionSections::strips() const {
  const Result<std::vector<PictureBox>> boxes = measuringBoxes();
  if (!boxes) return std::unexpected(boxes.error());
  std::string times;
  for (int k = 0; k < kShownFrames; ++k) {
    const int frame = k * (kKeyFrames - 1) / (kShownFrames - 1);
    std::string column;
    for (const TimeLaw law : kPaperLaws) {
      const double way = progress(law, shareOfTime(frame)).position;
      Result<Image> image = picture(way, kFrame);
      if (!image) return std::unexpected(image.error());
      drawBoxes(*image, *boxes);
      const auto figure = html::figure(
          *image, fmt::format("{}, frame {}: {:.0f} %", nameOf(law), frame, 100 * way));
      if (!figure) return figure;
      column += *figure;
    }
    times += "<div>" + column + "</div>\n";
  }
  return fmt::format("<div class=\"times\">{}</div>\n", times);
}

Result<std::vector<PictureBox>> MotionSections::measuringBoxes() const {
  const std::vector<std::string> usual{"mouth", "eye"};
  std::vector<PictureBox> boxes;
  const std::vector<Vec3> from = scenes_.points(rest_), to = scenes_.points(expression_);
  for (const std::string& name : regions_.empty() ? std::span(usual) : regions_) {
    const auto region = scenes_.region(name);
    if (!region && regions_.empty()) continue;  // this rig has none
    if (!region) return std::unexpected(region.error());
    std::vector<Vec3> places;
    for (const Index v : *region) {
      places.push_back(from[v]);
      places.push_back(to[v]);
    }
    boxes.push_back(boxAround(places, front_, kFrame));
  }
  return boxes;
}

std::string MotionSections::plots() const {
  const std::vector<Vec3> from = scenes_.points(rest_), to = scenes_.points(expression_);
  std::size_t furthest = 0;
  for (std::size_t v = 0; v < from.size(); ++v)
    if (norm(to[v] - from[v]) > norm(to[furthest] - from[furthest])) furthest = v;
  std::vector<Series> ways, velocities;
  for (const TimeLaw law : kPaperLaws) {
    const bool linear = law == TimeLaw::linear;
    Series way{std::string(nameOf(law)), linear ? kGrey : kBlue, {}, true};
    Series velocity = way;
    for (int frame = 0; frame < kKeyFrames; ++frame) {
      const double s = progress(law, shareOfTime(frame)).position;
      const double gone = norm(scenes_.points(scaled(expression_, s))[furthest] - from[furthest]);
      if (frame > 0) velocity.points.push_back({frame - 0.5, gone - way.points.back().y});
      way.points.push_back({1.0 * frame, gone});
    }
    ways.push_back(std::move(way));
    velocities.push_back(std::move(velocity));
  }
  return row(linePlot("Position", {"key frame"}, {"way gone"}, ways) +
                 linePlot("Velocity", {"key frame"}, {"way between two frames"}, velocities),
             "plots");
}

// ---- Every law ----

Result<std::string> MotionSections::everyLaw() const {
  const Result<std::string> sheet = sprites();
  if (!sheet) return sheet;
  std::string style = fmt::format(
      ".law{{display:inline-block;width:{0}px;margin:0 8px 12px 0;vertical-align:top}}"
      ".law i{{display:block;width:{0}px;height:{1}px;"
      "background:url(data:image/png;base64,{2}) -{3}px 0;animation:{4}s step-end infinite}}\n",
      kSprite.width, kSprite.height, *sheet, poseAt(1) * kSprite.width, kSeconds);
  std::string cells;
  const std::vector<ShownLaw> laws = sweepface::everyLaw();
  for (std::size_t k = 0; k < laws.size(); ++k) {
    style += moves(k, laws[k].path);
    cells += fmt::format(
        "<div class=\"law\"><i style=\"animation-name:law{}\"></i><b>{}</b><br/>{}</div>\n", k,
        html::escaped(laws[k].name), html::escaped(laws[k].use));
  }
  return section("Every law",
                 fmt::format("The same way to {} by every law, in a second, again and again; the "
                             "spring, the bounce and the impulse take longer. Below, position, "
                             "velocity and force over time.",
                             mixtureOf(rig_, expression_))) +
         fmt::format("<style>{}</style>\n<div>{}</div>\n<div class=\"wide\">{}</div>\n", style,
                     cells, lawSheet());
}

/// All poses in a row, as a PNG in base 64.
Result<std::string> MotionSections::sprites() const {
  Image sheet = Image::filled({kPoses * kSprite.width, kSprite.height}, {1, 1, 1});
  for (int k = 0; k < kPoses; ++k) {
    const Result<Image> pose = picture(kFurthest * k / (kPoses - 1), kSprite);
    if (!pose) return std::unexpected(pose.error());
    paste(sheet, *pose, k * kSprite.width, 0);
  }
  const Result<std::string> png = encodePng(sheet);
  if (!png) return png;
  return html::base64(*png);
}

}  // namespace sweepface
