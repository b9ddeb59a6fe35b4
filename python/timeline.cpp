#include "sweepface/timeline.hpp"

#include <fmt/format.h>

#include "sweepface/io.hpp"
#include "sweepface/regional_clips.hpp"

#include "bindings.hpp"
#include "clip.hpp"
#include "regions.hpp"

namespace sweepface::python {
namespace {

RegionalClips captureIn(const Clip& clip, const py::object& listed, double frequency,
                        double damping) {
  const std::vector<Matter> matters = mattersOf(dividedRegionsIn(listed));
  const Released others;
  auto clips = inRegions(clip, matters, {frequency, damping});
  if (!clips) throw Failure("The clip: " + clips.error().message);
  return std::move(*clips);
}

RegionalClips timelineIn(const Timeline& timeline, const py::object& listed) {
  const std::vector<Region> regions = dividedRegionsIn(listed);
  const Released others;
  auto clips = inRegions(timeline, namesOf(regions), mattersOf(regions));
  if (!clips) throw Failure("The timeline: " + clips.error().message);
  return std::move(*clips);
}

Timeline parsedTimeline(const std::string& text, const std::string& name) {
  return released([&] { return valueOf(parseTimeline(text, name)); });
}

std::vector<double> framesOf(const RegionalClips& clips) {
  std::vector<double> times;
  for (const Clip& clip : clips.ofRegions)
    times.insert(times.end(), clip.times.begin(), clip.times.end());
  mergeTimes(times);
  return times;
}

py::array_t<double> regionalWeightsOver(const RegionalClips& clips, const Rig& rig,
                                        const py::object& times) {
  const ClipMatch match = matchWith(clips.whole, rig, clips.missed);
  const py::object at = times.is_none() ? py::object(arrayOf(framesOf(clips))) : times;
  const std::size_t regions = clips.ofRegions.size(), targets = rig.targets.size();
  auto rows =
      rowsOver(clips.whole, at, regions * targets, [&](double seconds, std::span<double> row) {
        for (std::size_t r = 0; r < regions; ++r)
          match.spread(clips.ofRegions[r], seconds, row.subspan(r * targets, targets));
      });
  return rows.reshape(
      {rows.shape(0), static_cast<py::ssize_t>(regions), static_cast<py::ssize_t>(targets)});
}

}  // namespace

void addTimeline(py::module_& m) {
  using namespace py::literals;
  const Spring usual;
  py::class_<RegionalClips>(m, "RegionalClips", "A clip as every region of a face plays it.")
      .def_readonly("whole", &RegionalClips::whole,
                    "The clip itself, for head and eyes, which no region holds back.")
      .def_readonly("of_regions", &RegionalClips::ofRegions, "A clip for each region.")
      .def_property_readonly("seconds", &RegionalClips::seconds,
                             "Until the last region has arrived.")
      .def("weights_of", &regionalWeightsOver, "rig"_a, "times"_a = py::none(),
           "Weights of the rig's targets at times (those of the frames of all regions "
           "if not given) in every region, as Clip.weights_of has them: [T, R, K].")
      .def("__repr__", [](const RegionalClips& clips) {
        return fmt::format("<sweepface.RegionalClips: {} regions, {:.2f} s>",
                           clips.ofRegions.size(), clips.seconds());
      });
  py::class_<Timeline>(m, "Timeline", "Events that send weights to goals, in one region or in all.")
      .def_readonly("seconds", &Timeline::seconds, "How long it lasts, once.")
      .def_readonly("loops", &Timeline::loops, "How often it is played.")
      .def("in_regions", &timelineIn, "regions"_a,
           "As every region plays it, each by its own mass, stiffness and delay; the regions are "
           "as Rig.divide returns them.")
      .def("__repr__", [](const Timeline& timeline) {
        return fmt::format("<sweepface.Timeline: {} events, {:.2f} s>", timeline.events.size(),
                           timeline.seconds * timeline.loops);
      });
  py::reinterpret_borrow<py::class_<Clip>>(m.attr("Clip"))
      .def(
          "in_regions", &captureIn, "regions"_a, py::kw_only(), "frequency"_a = usual.frequency,
          "damping"_a = usual.damping,
          "As every region plays it, the regions being as Rig.divide returns them: late by its "
          "delay, and what its mass has beyond 1 hangs on the weights by springs of this frequency "
          "and damping.");
  m.def(
      "read_timeline",
      [](const std::filesystem::path& path) {
        return parsedTimeline(valueOf(readFile(path)), path.string());
      },
      "path"_a,
      "Reads a timeline (.json), which may have events for single regions. read_clip reads one for "
      "the whole face.");
  m.def("parse_timeline", &parsedTimeline, "text"_a, "name"_a = "The timeline",
        "The same from a text, which messages call by the name.");
}

}  // namespace sweepface::python
