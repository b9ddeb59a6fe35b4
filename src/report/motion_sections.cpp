#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/motion.hpp"
#include "sweepface/plot.hpp"

#include "report/maker.hpp"
#include "report/shape_study.hpp"

namespace sweepface {
namespace {

constexpr PictureSize kFrame{232, 290}, kPatch{360, 270};
constexpr int kKeyFrames = 31, kShownFrames = 6;

/// -10000 as "−10,000".
std::string parameter(double x) {
  return (x < 0 ? "−" : "") + count(static_cast<std::size_t>(std::abs(x)));
}

double shareOfTime(int frame) { return static_cast<double>(frame) / (kKeyFrames - 1); }

}  // namespace

// ---- Shape parameters ----

Result<std::string> ReportMaker::shapes() {
  const ShapeStudy study = studyShapes(rig_.surface, blend(rig_, rest_));
  if (study.shapes.empty()) return "";
  const Camera camera = frameCamera(study.shapes.front().scene.positions, study.view, kPatch, 0.08);
  Figures figures;
  std::vector<Series> profiles;
  constexpr std::array colours{kGrey, kBlue, kGreen, kRed};
  for (std::size_t k = 0; k < study.shapes.size(); ++k) {
    const ShapedPatch& s = study.shapes[k];
    const bool plain = k == 0;
    std::string name = fmt::format("η = {}, λ = {}", parameter(s.eta), parameter(s.lambda));
    if (!plain) name += fmt::format(": moves by up to {}", number(s.moved));
    figures.add(picture(s.scene, camera, name, kPatch));
    profiles.push_back({fmt::format("{} / {}", parameter(s.eta), parameter(s.lambda)),
                        colours[k % colours.size()], s.profile, false, plain});
  }
  if (figures.error) return std::unexpected(*figures.error);
  return section(
             "Shape parameters",
             fmt::format("Patch {} under ρS⁽⁶⁾ + ηS⁽⁴⁾ + λS″ = 0 with ρ = 1 and several η and λ, "
                         "measured over the whole sweep. Its two boundary curves stay with their "
                         "first and second derivatives. In between, −η draws it towards a cubic "
                         "and λ towards a straight line, like a strip under tension. The plot "
                         "shows the height of the sweep's middle line above its chord, by η / λ.",
                         study.patch)) +
         row(figures.html, "four") +
         linePlot("Profile of the sweep", {"way along the sweep"}, {"height"}, profiles);
}

// ---- Motion ----

Result<std::string> ReportMaker::motion() {
  if (!moves_) return "";
  const Result<std::string> frames = strips();
  if (!frames) return std::unexpected(frames.error());
  return section("Linear and Newton",
                 fmt::format("The way from the neutral to {} in {} key frames, of which every "
                             "sixth is shown, counted from 0; the boxes stay where they are. "
                             "Linear interpolation goes the same way in every frame. Under "
                             "Newton's second law a constant force accelerates the face from "
                             "rest: its velocity grows evenly. The plots follow the point of the "
                             "face that goes furthest.",
                             mixture(), kKeyFrames)) +
         *frames + motionPlots();
}

Result<std::string> ReportMaker::strips() {
  constexpr std::array laws{TimeLaw::linear, TimeLaw::newton};
  const FaceScenes scenes(rig_, lodFor(rig_.surface, Style::shaded, kFrame));
  const std::vector<Box> boxes = measuringBoxes();
  std::string times;
  for (int k = 0; k < kShownFrames; ++k) {
    const int frame = k * (kKeyFrames - 1) / (kShownFrames - 1);
    Figures column;
    for (const TimeLaw law : laws) {
      Weights weights = expression_;
      const double way = progress(law, shareOfTime(frame)).position;
      for (double& w : weights) w *= way;
      column.add(picture(scenes.scene(weights, Style::shaded), front_,
                         fmt::format("{}, frame {}: {:.0f} %", nameOf(law), frame, 100 * way),
                         kFrame, boxes));
    }
    if (column.error) return std::unexpected(*column.error);
    times += "<div>" + column.html + "</div>\n";
  }
  return fmt::format("<div class=\"times\">{}</div>\n", times);
}

std::vector<Box> ReportMaker::measuringBoxes() const {
  std::vector<Box> boxes;
  const std::vector<Vec3> from = scenes_.points(rest_), to = scenes_.points(expression_);
  for (const std::string& name : options_.regions) {
    const auto region = scenes_.region(name);
    if (!region) continue;  // this rig has none
    std::vector<Vec3> places;
    for (const Index v : *region) {
      places.push_back(from[v]);
      places.push_back(to[v]);
    }
    boxes.push_back(boxAround(places, front_, kFrame));
  }
  return boxes;
}

std::string ReportMaker::motionPlots() const {
  const std::vector<Vec3> from = scenes_.points(rest_), to = scenes_.points(expression_);
  std::size_t furthest = 0;
  for (std::size_t v = 0; v < from.size(); ++v)
    if (norm(to[v] - from[v]) > norm(to[furthest] - from[furthest])) furthest = v;
  std::vector<Series> ways, velocities;
  for (const TimeLaw law : {TimeLaw::linear, TimeLaw::newton}) {
    const bool linear = law == TimeLaw::linear;
    Series way{std::string(nameOf(law)), linear ? kGrey : kBlue, {}, true};
    Series velocity = way;
    for (int frame = 0; frame < kKeyFrames; ++frame) {
      Weights weights = expression_;
      const double s = shareOfTime(frame);
      for (double& w : weights) w *= progress(law, s).position;
      const double gone = norm(scenes_.points(weights)[furthest] - from[furthest]);
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

}  // namespace sweepface
