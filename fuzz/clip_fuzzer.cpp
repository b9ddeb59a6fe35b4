#include <cmath>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/filter.hpp"
#include "sweepface/region_file.hpp"
#include "sweepface/regional_motion.hpp"
#include "sweepface/timeline.hpp"

#include "mesh_properties.hpp"

namespace sweepface::fuzzing {
namespace {

constexpr const char* kName = "input";

/// An error is a sentence about the file, or a question.
template <typename T>
bool isRead(const Result<T>& result) {
  if (result) return true;
  const std::string& message = result.error().message;
  require(message.starts_with(kName) && isSentence(message));
  return false;
}

/// Times increase, and every number is finite.
void requireSound(const Clip& clip) {
  require(clip.weights.size() == clip.times.size() * clip.names.size());
  for (std::size_t f = 0; f < clip.times.size(); ++f)
    require(std::isfinite(clip.times[f]) && (f == 0 || clip.times[f] > clip.times[f - 1]));
  for (const double weight : clip.weights) require(std::isfinite(weight));
}

bool isSmall(const Clip& clip) { return clip.weights.size() <= 200 && clip.seconds() <= 20; }

/// A capture that was written can be read again.
void requireWritable(const Clip& clip) {
  const auto text = formatLiveLinkCsv(clip);
  if (!text) return;
  const auto again = parseLiveLinkCsv(*text, kName);
  require(again && again->times.size() == clip.times.size());
}

void play(Clip clip) {
  requireSound(clip);
  requireWritable(clip);
  smooth(clip);
  requireSound(clip);
  if (isSmall(clip)) requireSound(inMatter(clip, {4, 0.5, 0.1}));
}

void play(const Timeline& timeline) {
  std::size_t goals = 0;
  for (const TimelineEvent& event : timeline.events) goals += event.goals.size();
  if (timeline.seconds * timeline.loops > 5 || timeline.loops > 3 || goals > 20) return;
  for (const Matter& matter : {Matter{}, Matter{4, 0.5, 0.1}})
    if (const auto baked = bakeToPlay(timeline, "", matter)) requireSound(baked->clip);
}

/// Renames a clip that has all names of a map.
void rename(const NameMap& map) {
  std::vector<std::string> targets;
  Clip clip{{"HeadYaw"}, {0, 1}, {}};
  for (const auto& [name, drives] : map.drives) {
    clip.names.push_back(name);
    for (const auto& [target, factor] : drives) targets.push_back(target);
  }
  clip.weights.assign(2 * clip.names.size(), 0.5);
  if (const auto made = renamed(std::move(clip), map, targets); isRead(made)) requireSound(*made);
}

}  // namespace
}  // namespace sweepface::fuzzing

// Reads captures, timelines, regions and maps of names, and plays what is short.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sweepface;
  using namespace fuzzing;
  const std::string_view text = asText(data, size);
  for (const auto& clip : {parseLiveLinkCsv(text, kName), parseLiveLinkCsv(text, kName, 60),
                           parseClipJson(text, kName), parseClipJson(text, kName, 25)})
    if (isRead(clip)) play(*clip);
  if (const auto timeline = parseTimeline(text, kName); isRead(timeline)) play(*timeline);
  if (const auto regions = parseRegions(text, kName); isRead(regions))
    for (const PaintedRegion& region : *regions) require(check(region.matter).has_value());
  if (const auto map = parseNameMap(text, kName); isRead(map)) rename(*map);
  return 0;
}
