#include "sweepface/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>

#include "sweepface/eval.hpp"
#include "sweepface/io.hpp"
#include "sweepface/trajectory.hpp"

#include "command.hpp"
#include "performance.hpp"
#include "regions.hpp"

namespace sweepface::cli {
namespace {

struct PlotArguments {
  std::string face, output;
  PerformanceArguments what;
  std::vector<std::string> laws, weights;
  std::vector<int> vertices;
  double mass = 1;
  bool quiet = false;
};

void addOptions(CLI::App& app, PlotArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output, "The .svg file to write");
  addPerformance(app, a.what);
  oneEachTime(app.add_option("--laws", a.laws, "Several laws in one plot, instead of --law"))
      ->delimiter(',')
      ->excludes("--law")
      ->excludes("--clip")
      ->type_name("LAW,...");
  oneEachTime(
      app.add_option("--weight", a.weights,
                     "Targets whose weight is shown; the first that moves if nothing is named"))
      ->check(notEmpty())
      ->delimiter(',')
      ->type_name("NAME,...");
  oneEachTime(app.add_option("--vertex", a.vertices,
                             "Vertices of the source, counted from 0, whose path is shown"))
      ->delimiter(',')
      ->transform(wholeNumber(0, std::numeric_limits<int>::max()))
      ->type_name("N,...");
  app.add_option("--mass", a.mass, "The mass that the force moves")
      ->check(positiveNumber())
      ->capture_default_str()
      ->type_name("M");
  addQuiet(app, a.quiet);
  app.footer(
      "\nPosition, velocity, acceleration and force over time. A vertex is shown by its distance "
      "from where it\nstarts and by the lengths of the others.\n\nExamples:\n"
      "  sweepface plot face.sweep --to jawOpen=1 --laws linear,newton,spring -o laws.svg\n"
      "  sweepface plot face.sweep --clip take.csv --weight jawOpen,eyeBlinkLeft -o take.svg");
}

// ---- What is shown ----

// Anything smaller than this share of the way cannot be seen.
constexpr double kVisible = 1e-3;

/// The visible swings or bounces of a law: how many, when each begins, and what makes them fewer.
struct Repeats {
  double count = 0;
  std::function<double(double repeat)> startOf;
  const char* remedy = "";
};

Repeats swings(const PerformanceArguments& what, double seconds) {
  const double dying = -std::log(kVisible) / (2 * std::numbers::pi * std::min(what.damping, 1.0));
  return {std::min(what.frequency * seconds, 1 + dying),
          [f = what.frequency](double swing) { return swing / f; },
          "fewer --seconds, less --frequency or more --damping"};
}

/// Bounce n lasts 2 eⁿ falls and begins with eⁿ of the fall's speed; bounce 0 is only the second
/// half of a bounce, the fall itself.
Repeats bounces(const PerformanceArguments& what, double seconds) {
  const double e = what.restitution, fall = seconds * (1 - e) / (1 + e);
  return {e > 0 ? 1 + std::log(kVisible) / std::log(e) : 1,
          [e, fall](double bounce) {
            return bounce == 0 ? 0 : fall * (1 + 2 * e * (1 - std::pow(e, bounce - 1)) / (1 - e));
          },
          "less --restitution"};
}

/// The times to sample: evenly, often enough for swings and bounces, and at a clip's own frames.
Result<std::vector<double>> looksAt(const PerformanceArguments& what,
                                    const Performance& performance) {
  constexpr double kEvenly = 240, kMost = 8000, kARepeat = 24;
  const double seconds = performance.seconds;
  std::vector<double> times = performance.frameTimes;
  for (double k = 0; k <= kEvenly; ++k) times.push_back(seconds * k / kEvenly);
  const std::string law = what.clip.empty() ? what.law : "";
  Repeats repeats;
  if (law == "spring") repeats = swings(what, seconds);
  if (law == "bounce") repeats = bounces(what, seconds);
  if (repeats.count > kMost)
    return fail(fmt::format("{:.4g} swings or bounces are more than a plot can show; give it {}.",
                            repeats.count, repeats.remedy));
  for (double n = 0; n < repeats.count; ++n) {
    const double start = repeats.startOf(n), end = std::min(repeats.startOf(n + 1), seconds);
    for (double k = 0; k < kARepeat; ++k) times.push_back(std::lerp(start, end, k / kARepeat));
    for (const double share : {1e-9, 1 - 1e-9})  // on both sides of where a bounce turns
      times.push_back(std::lerp(start, end, share));
  }
  if (law == "bounce")  // it is at rest at the end, and nowhere before
    for (double& time : times) time = std::min(time, seconds * (1 - 1e-9));
  std::ranges::sort(times);
  times.erase(std::ranges::unique(times).begin(), times.end());
  return times;
}

/// What is plotted: a weight or a vertex.
struct Subject {
  std::string name;
  std::vector<Vec3> differences;  ///< [targets] what a weight of 1 adds to its place

  /// The number to plot, given that of every weight.
  double measure(std::span<const double> weights) const {
    Vec3 sum;
    for (std::size_t k = 0; k < differences.size(); ++k) sum += weights[k] * differences[k];
    return isWeight ? sum.x : norm(sum);
  }
  bool isWeight = true;
};

/// The target that this one is a region's part of, or itself.
Index wholeOf(const Performance& performance, Index target) {
  return performance.isDivided ? performance.wholes[target] : target;
}

/// A region's weight: that of the whole target plus that of its part.
Subject weightOf(const Rig& rig, const Performance& performance, Index target) {
  Subject subject{rig.targets[target].name, std::vector<Vec3>(rig.targets.size())};
  for (const Index k : {target, wholeOf(performance, target)}) subject.differences[k] = {1, 0, 0};
  return subject;
}

/// One for every region if the weight differs between regions.
std::vector<Subject> weightsOf(const Rig& rig, const Performance& performance, Index target) {
  std::vector<Subject> parts;
  for (Index k = 0; k < static_cast<Index>(rig.targets.size()); ++k)
    if (k != target && wholeOf(performance, k) == target)
      parts.push_back(weightOf(rig, performance, k));
  return parts.empty() ? std::vector{weightOf(rig, performance, target)} : parts;
}

std::vector<Subject> verticesOf(const Rig& rig, const std::vector<int>& vertices) {
  std::vector<Subject> subjects;
  for (const int v : vertices) subjects.push_back({fmt::format("vertex {}", v), {}, false});
  if (subjects.empty()) return subjects;
  const Tessellation grid(rig.surface, 1);
  Weights weights(rig.targets.size());
  const auto places = [&] { return sourcePositions(rig, grid, blend(rig, weights), weights); };
  const std::vector<Vec3> rest = places();
  for (double& w : weights) {
    w = 1;
    const std::vector<Vec3> moved = places();
    w = 0;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      subjects[k].differences.push_back(moved[vertices[k]] - rest[vertices[k]]);
  }
  return subjects;
}

Result<std::vector<Subject>> subjectsOf(const PlotArguments& a, const Rig& rig,
                                        const Performance& performance,
                                        std::span<const double> times) {
  std::vector<Subject> subjects;
  for (const std::string& name : a.weights) {
    const Result<Index> target = findTarget(rig, name);
    if (!target) return std::unexpected(target.error());
    std::ranges::move(weightsOf(rig, performance, *target), std::back_inserter(subjects));
  }
  if (!a.vertices.empty() && !rig.source.ownOrder)
    return fail(a.face +
                " has no source order, it was left out, so that nobody knows which vertex is "
                "which; leave --vertex out, or make the file again without --strip order.");
  const auto count = static_cast<int>(rig.source.gridVertex.size());
  for (const int vertex : a.vertices)
    if (vertex >= count)
      return fail(
          fmt::format("There is no vertex {}; the face has {}, counted from 0.", vertex, count));
  std::ranges::move(verticesOf(rig, a.vertices), std::back_inserter(subjects));
  if (!subjects.empty()) return subjects;
  std::vector<double> first(rig.targets.size()), later(rig.targets.size());
  performance.at(0, first);
  for (const double time : times) {
    performance.at(time, later);
    for (std::size_t t = 0; t < first.size(); ++t)
      if (later[t] != first[t])
        return weightsOf(rig, performance, wholeOf(performance, static_cast<Index>(t)));
  }
  return fail("Nothing moves; name a target with --weight.");
}

// ---- Curves ----

constexpr std::array kColours{"#8a8e96", "#1a6aa8", "#d63f29", "#2a9d55",
                              "#b8860b", "#7b4fa3", "#1b9aaa", "#e07a9a"};
constexpr std::size_t kCurveLooks = kColours.size() * kDashes;

/// Position, velocity, acceleration and force.
using Curves = std::array<std::vector<Series>, 4>;

void addCurves(Curves& curves, const Performance& performance, std::span<const double> times,
               const Subject& subject, const std::string& name, double mass) {
  const std::size_t place = curves[0].size();
  const auto round = static_cast<int>(place / kColours.size());  // goes up when colours recur
  for (auto& panel : curves)
    panel.push_back({name, kColours[place % kColours.size()], {}, false, round % kDashes});
  const std::size_t count = subject.differences.size();
  std::vector<Kinematics> now(count);
  std::vector<double> start(count), values(count);
  performance.at(0, start);
  for (const double time : times) {
    performance.kinematicsAt(time, now);
    const auto add = [&](std::size_t panel, auto value) {
      for (std::size_t t = 0; t < count; ++t) values[t] = value(t);
      curves[panel][place].points.push_back({time, subject.measure(values)});
    };
    add(0, [&](std::size_t t) { return now[t].position - (subject.isWeight ? 0 : start[t]); });
    add(1, [&](std::size_t t) { return now[t].velocity; });
    add(2, [&](std::size_t t) { return now[t].acceleration; });
    add(3, [&](std::size_t t) { return mass * now[t].acceleration; });
  }
}

struct Plotted {
  Curves curves;
  std::vector<std::string> notes;  // what the user should know
};

/// Adds the parts of a timeline's regions to the rig.
Result<Plotted> curvesOf(const PlotArguments& a, Rig& rig) {
  const std::vector<std::string> laws = a.laws.empty() ? std::vector{a.what.law} : a.laws;
  std::vector<Performance> performances;
  std::vector<std::vector<double>> times;
  for (const std::string& law : laws) {
    PerformanceArguments what = a.what;
    what.law = law;
    Result<Performance> performance = perform(what, {}, {}, rig);
    if (!performance) return std::unexpected(performance.error());
    auto looks = looksAt(what, *performance);
    if (!looks) return std::unexpected(looks.error());
    times.push_back(std::move(*looks));
    performances.push_back(std::move(*performance));
  }
  const auto subjects = subjectsOf(a, rig, performances.front(), times.front());
  if (!subjects) return std::unexpected(subjects.error());
  Curves curves;
  for (std::size_t k = 0; k < laws.size(); ++k)
    for (const Subject& subject : *subjects)
      addCurves(curves, performances[k], times[k], subject,
                laws.size() == 1        ? subject.name
                : subjects->size() == 1 ? laws[k]
                                        : laws[k] + ", " + subject.name,
                a.mass);
  constexpr double kLargest = 1e300;  // axes end at the next round number
  for (const auto& panel : curves)
    for (const Series& series : panel)
      for (const Vec2& p : series.points)
        if (!(std::abs(p.y) < kLargest))
          return fail(
              "The motion or its force is beyond what numbers hold; give it other seconds, "
              "weights or another --mass.");
  std::vector<std::string>& notes = performances.front().notes;
  if (curves[0].size() > kCurveLooks)
    notes.push_back(
        fmt::format("{} curves are more than the {} colours and dashes there are: some "
                    "look the same. Name fewer with --weight or --vertex.",
                    curves[0].size(), kCurveLooks));
  return Plotted{std::move(curves), std::move(notes)};
}

Result<int> runPlot(const PlotArguments& a) {
  if (!a.what.to && a.what.clip.empty())
    return fail("Say where to go with --to, or what to play with --clip.");
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  if (auto ok = checkOutput(a.output, {a.face, a.what.clip}, {".svg"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  const Result<Plotted> plotted = curvesOf(a, *rig);
  if (!plotted) return std::unexpected(plotted.error());
  const auto& [positions, velocities, accelerations, forces] = plotted->curves;
  const std::string svg =
      plotSheet({linePlot("Position", {"seconds"}, {"way"}, positions),
                 linePlot("Velocity", {"seconds"}, {"per second"}, velocities),
                 linePlot("Acceleration", {"seconds"}, {"per second²"}, accelerations),
                 linePlot("Force", {"seconds"}, {"mass × per second²"}, forces)});
  if (auto written = writeFile(utf8Path(a.output), svg); !written)
    return std::unexpected(written.error());
  for (const std::string& note : plotted->notes) printWarning(note);
  if (!a.quiet)
    fmt::print("{}: {} curve{}\n", a.output, positions.size(), positions.size() == 1 ? "" : "s");
  return 0;
}

}  // namespace

Command addPlot(CLI::App& tool) {
  return makeCommand(tool, "plot", "Plot how weights and vertices move (.svg)", runPlot);
}

}  // namespace sweepface::cli
