#include "clip.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sweepface/filter.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/head.hpp"
#include "sweepface/io.hpp"
#include "sweepface/keys.hpp"
#include "sweepface/region_file.hpp"
#include "sweepface/regional_clips.hpp"

#include "bindings.hpp"

namespace sweepface::python {
namespace {

// ---- Reading and making ----

Result<Clip> played(const Timeline& timeline, const std::string& text, const std::string& name) {
  auto clips = inRegions(timeline, std::vector<std::string>{"rest"}, std::vector<Matter>(1));
  if (!clips) return fail(fmt::format("{}: {}", name, clips.error().message));
  Clip& whole = clips->whole;
  whole.warnings = notesOnClip(whole, matchClip(whole, {}), clips->missed, {}, name);
  const auto regions = parseRegions(text, name);
  if (!regions) return std::unexpected(regions.error());
  if (!regions->empty())
    whole.warnings.push_back(fmt::format(
        "{}: its regions are left out; read_timeline and Timeline.in_regions play them.", name));
  return std::move(whole);
}

Result<Clip> parsedClip(const std::filesystem::path& path, const std::string& text,
                        double framesPerSecond, const std::string& animation) {
  const std::string kind = extensionOf(path), name = path.string();
  const bool hasScene = isGltf(path), isJson = kind == ".json";
  if (!hasScene && !isJson && kind != ".csv")
    return fail(fmt::format("{} is neither a .csv, a .json, a .glb, a .gltf nor a .vrm.", name));
  if (!hasScene && !animation.empty())
    return fail(fmt::format("{} has no animations to choose from, as a .glb has.", name));
  const bool hasTimes = hasScene || (isJson && isTimeline(text));
  if (hasTimes && framesPerSecond > 0)
    return fail(fmt::format("{} tells its own times; leave frames_per_second out.", name));
  if (hasScene) return parseGltfClip(text, name, folderOf(path), animation);
  if (!isJson) return parseLiveLinkCsv(text, name, framesPerSecond);
  if (!hasTimes) return parseClipJson(text, name, framesPerSecond);
  const auto timeline = parseTimeline(text, name);
  if (!timeline) return std::unexpected(timeline.error());
  return played(*timeline, text, name);
}

void checkRate(double framesPerSecond) {
  if (!(framesPerSecond >= 0 && framesPerSecond <= 1000))
    throw Failure(
        fmt::format("frames_per_second must be between 0 and 1000, not {}.", framesPerSecond));
}

Clip readClip(const std::filesystem::path& path, double framesPerSecond,
              const std::string& animation) {
  checkRate(framesPerSecond);
  auto clip = valueOf(parsedClip(path, valueOf(readFile(path)), framesPerSecond, animation));
  warn(clip.warnings);
  return clip;
}

Clip clipFrom(const std::vector<std::string>& names, const Doubles& times, const Doubles& weights) {
  const auto at = numbersIn(times, "The times");
  if (weights.ndim() != 2 || weights.shape(0) != times.size() ||
      weights.shape(1) != static_cast<py::ssize_t>(names.size()))
    throw Failure(fmt::format("The weights of {} times and {} names must be an array [{}, {}].",
                              at.size(), names.size(), at.size(), names.size()));
  if (!std::ranges::all_of(at, isPlausibleTime) ||
      std::ranges::adjacent_find(at, std::greater_equal{}) != at.end())
    throw Failure("The times must be seconds that increase from frame to frame.");
  const std::span<const double> given{weights.data(), static_cast<std::size_t>(weights.size())};
  checkWeights(given);
  return {names, {at.begin(), at.end()}, {given.begin(), given.end()}};
}

// ---- Other clips made of one ----

Clip smoothed(Clip clip, double cutoff, double speedGain, double speedCutoff) {
  for (const double hertz : {cutoff, speedCutoff})
    if (!(hertz > 0 && hertz <= 1e6))
      throw Failure("The cutoffs must be greater than 0 hertz, and at most a million.");
  if (!(speedGain >= 0 && speedGain <= 1e6))
    throw Failure("The gain of the speed must be between 0 and a million.");
  smooth(clip, {cutoff, speedGain, speedCutoff});
  return clip;
}

std::vector<NameMap::Drive> drivesFrom(const py::object& driven) {
  if (driven.is_none()) return {};
  if (py::isinstance<py::str>(driven)) return {{py::cast<std::string>(driven)}};
  std::vector<NameMap::Drive> drives;
  if (py::isinstance<py::list>(driven) || py::isinstance<py::tuple>(driven)) {
    for (const auto& target : driven) drives.push_back({textFrom(target, "A target's name")});
    return drives;
  }
  if (!isMapping(driven))
    throw Failure("What a name drives is a name, a list of names, a dict of numbers, or None.");
  for (const auto& [target, factor] : mappingFrom(driven, "What a name drives"))
    drives.push_back({textFrom(target, "A target's name"), numberFrom(factor, "A factor")});
  return drives;
}

Clip withNames(Clip clip, const py::object& names, const Rig& rig) {
  NameMap map{"The map of names", {}};
  for (const auto& [name, driven] : mappingFrom(names, "Names"))
    map.drives.emplace_back(textFrom(name, "A name"),
                            drivesFrom(py::reinterpret_borrow<py::object>(driven)));
  if (map.drives.empty()) throw Failure("Names are empty; give targets by names of the clip.");
  clip.warnings.clear();
  Clip other = valueOf(renamed(std::move(clip), map, rig.targetNames()));
  warn(other.warnings);
  return other;
}

}  // namespace

// ---- Weights ----

ClipMatch matchWith(const Clip& clip, const Rig& rig, double missed) {
  const std::vector<std::string> targets = rig.targetNames();
  ClipMatch match = matchClip(clip, targets);
  if (!movesAnything(clip, match))
    throw Failure(
        fmt::format("None of the clip's {} names is a target of the rig.", clip.names.size()));
  auto notes = notesOnClip(clip, match, missed, targets, "The clip");
  if (const auto idle = idleNames(clip, match); !idle.empty())
    notes.push_back(fmt::format("{} of the clip's {} names drive no target of the rig: {}.",
                                idle.size(), clip.names.size(), fmt::join(idle, ", ")));
  warn(notes);
  return match;
}

namespace {

py::array_t<double> weightsOver(const Clip& clip, const Rig& rig, const py::object& times) {
  const ClipMatch match = matchWith(clip, rig);
  return rowsOver(clip, times, rig.targets.size(),
                  [&](double seconds, std::span<double> row) { match.spread(clip, seconds, row); });
}

py::dict matchOf(const Clip& clip, const Rig& rig) {
  const ClipMatch match = matchClip(clip, rig.targetNames());
  py::dict driven;
  for (std::size_t k = 0; k < clip.names.size(); ++k) {
    py::list names;
    for (const Index target : match.targets[k]) names.append(rig.targets[target].name);
    driven[textOf(clip.names[k])] = names;
  }
  return driven;
}

py::dict keysOf(const Clip& clip, double tolerance) {
  if (!(tolerance > 0)) throw Failure("The tolerance of keys must be greater than 0.");
  const CubicKeys keys = fewestKeys(clip, tolerance);
  const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(keys.times.size()),
                                       static_cast<py::ssize_t>(keys.names.size())};
  py::dict table;
  table["times"] = arrayOf(keys.times);
  table["values"] = arrayOf(std::span<const double>(keys.values), shape);
  table["slopes_in"] = arrayOf(std::span<const double>(keys.in), shape);
  table["slopes_out"] = arrayOf(std::span<const double>(keys.out), shape);
  return table;
}

}  // namespace

Clip clipOfTargets(const Rig& rig, const Clip& clip) {
  const ClipMatch match = matchWith(clip, rig);
  Clip spread{rig.targetNames(), clip.times, {}, {}, clip.title};
  std::vector<double> row(rig.targets.size());
  for (const double time : clip.times) {
    match.spread(clip, time - clip.times.front(), row);
    spread.weights.insert(spread.weights.end(), row.begin(), row.end());
  }
  return spread;
}

void addClip(py::module_& m) {
  using namespace py::literals;
  const OneEuro usual;
  py::class_<Clip>(m, "Clip", "Weights over time, as a tracker or an animator gives them.")
      .def(py::init(&clipFrom), "names"_a, "times"_a, "weights"_a,
           "names [N], times [F] in seconds that increase, weights [F, N].")
      .def_property_readonly("names",
                             [](const Clip& clip) {
                               py::list names;
                               for (const std::string& name : clip.names)
                                 names.append(textOf(name));
                               return names;
                             })
      .def_readonly("title", &Clip::title, "Of the animation in its file, or empty.")
      .def_property_readonly(
          "times", [](const Clip& clip) { return arrayOf(clip.times); },
          "[F] seconds; those of a capture are of the day.")
      .def_property_readonly("seconds", &Clip::seconds, "From the first frame to the last.")
      .def_property_readonly(
          "weights",
          [](const Clip& clip) {
            return arrayOf(std::span<const double>(clip.weights),
                           {static_cast<py::ssize_t>(clip.times.size()),
                            static_cast<py::ssize_t>(clip.names.size())});
          },
          "[F, N]")
      .def("smoothed", &smoothed, "cutoff"_a = usual.cutoff, "speed_gain"_a = usual.speedGain,
           "speed_cutoff"_a = usual.speedCutoff,
           "Without a tracker's noise, by the one-euro filter from both ends, so that nothing "
           "lags.")
      .def("keys", &keysOf, "tolerance"_a,
           "As few cubic keys as keep every weight within the tolerance: times [T], values, "
           "slopes_in and slopes_out [T, N].")
      .def(
          "save_csv",
          [](const Clip& clip, const std::filesystem::path& path, double framesPerSecond) {
            checkKind(path, ".csv");
            checkRate(framesPerSecond);
            valueOf(writeFile(path, valueOf(formatLiveLinkCsv(clip, framesPerSecond))));
          },
          "path"_a, "frames_per_second"_a = 60,
          "Writes a capture of the Live Link Face app, whose timecodes count frames of this rate; "
          "the clip's own frames stay. Another rate than 60 must be given when it is read.")
      .def("__repr__", [](const Clip& clip) {
        return fmt::format("<sweepface.Clip: {} frames of {} weights, {:.2f} s>", clip.times.size(),
                           clip.names.size(), clip.seconds());
      });
  m.def("read_clip", &readClip, "path"_a, py::kw_only(), "frames_per_second"_a = 0,
        "animation"_a = "",
        "Reads a capture of Live Link Face (.csv), Audio2Face or MediaPipe (.json), an animation "
        "of morph targets (.glb, .gltf, .vrm; the first, or that of the name), or a timeline "
        "(.json). "
        "frames_per_second, if given, is that of captures that do not tell.");
}

void addClipsOfRigs(py::module_& m) {
  using namespace py::literals;
  py::reinterpret_borrow<py::class_<Clip>>(m.attr("Clip"))
      .def("weights_of", &weightsOver, "rig"_a, "times"_a = py::none(),
           "Weights of the rig's targets at times (those of the frames if not given), linear "
           "between frames and held at the ends: [T, K]. Names match as in `match`; targets that "
           "nothing drives are at 0. Warns of names that move and drive none; raises Error if no "
           "name drives one.")
      .def("match", &matchOf, "rig"_a,
           "The targets that each name drives. Case, '_', '-', '.', ' ' and whether a side is "
           "spelt out do not count; a name without a side drives both, except a side that has "
           "a name of its own.")
      .def("renamed", &withNames, "names"_a, "rig"_a,
           "For rigs whose targets are called otherwise: {'jawOpen': 'mouth-open', 'cheekPuff': "
           "{'puff': 0.8}}; a list names several, None none.");
}

}  // namespace sweepface::python
