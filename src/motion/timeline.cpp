#include "sweepface/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sweepface {
namespace {

/// Where weights stand among the names of a clip.
using Places = std::map<std::string_view, std::size_t>;

Result<void> play(const TimelineEvent& event, const Places& places, const Matter& matter,
                  MotionState& state) {
  const Drive drive = inMatter(event.drive, matter);
  std::vector<bool> named(places.size(), false);
  for (const auto& [name, goal] : event.goals) {
    const std::size_t k = places.at(name);
    named[k] = true;
    if (auto ok = state.moveTo(k, goal, drive); !ok) return ok;
  }
  for (std::size_t k = 0; event.others && k < named.size(); ++k)
    if (!named[k])
      if (auto ok = state.moveTo(k, 0, drive); !ok) return ok;
  return {};
}

}  // namespace

Result<void> checkRegions(const Timeline& timeline, std::span<const std::string> regions) {
  for (const TimelineEvent& event : timeline.events)
    if (!event.region.empty() && std::ranges::find(regions, event.region) == regions.end())
      return fail("an event is for a region '", event.region, "' that there is not.");
  return {};
}

Result<Clip> bake(const Timeline& timeline, double framesPerSecond) {
  return bake(timeline, framesPerSecond, {}, {});
}

Result<Clip> bake(const Timeline& timeline, double framesPerSecond, std::string_view region,
                  const Matter& matter) {
  // A late region does all of it later.
  const double seconds = timeline.seconds * timeline.loops + matter.delay;
  // The last one is at the end, even where that is no whole number of frames.
  const double frames = std::ceil(seconds * framesPerSecond - 1e-6);
  if (!(framesPerSecond > 0) || !(frames >= 1 && frames <= 1e6))
    return failCall(
        "A timeline is baked into 1 to 1,000,000 frames; change its length or the rate.");
  Clip clip;
  Places places;
  for (const TimelineEvent& event : timeline.events)
    for (const auto& [name, goal] : event.goals)
      if (places.try_emplace(name, clip.names.size()).second) clip.names.push_back(name);
  if ((frames + 1) * static_cast<double>(clip.names.size()) > kMostClipWeights)
    return failCall(
        "The timeline bakes into more weights than a clip can hold; shorten it, or name fewer.");
  if (static_cast<double>(timeline.events.size()) * timeline.loops *
          static_cast<double>(clip.names.size()) >
      kMostClipWeights)
    return failCall(
        "The timeline sends weights off more often than a clip can tell; repeat it less, or name "
        "fewer.");
  auto state = MotionState::make(std::vector<double>(clip.names.size(), 0.0));
  if (!state) return std::unexpected(state.error());

  std::size_t next = 0;
  int loop = 0;
  std::vector<double> weights(clip.names.size());
  for (double frame = 0; frame <= frames; ++frame) {
    const double time = frame < frames ? frame / framesPerSecond : seconds;
    // Everything that sets out until this frame does so at its own instant; by the last, all does.
    while (loop < timeline.loops) {
      if (next == timeline.events.size()) {
        next = 0, ++loop;
        continue;
      }
      const TimelineEvent& event = timeline.events[next];
      const double start = event.time + loop * timeline.seconds + matter.delay;
      if (start > time && frame < frames) break;
      state->advance(start - state->now());
      const bool here = event.region.empty() || event.region == region;
      if (auto ok = here ? play(event, places, matter, *state) : Result<void>{}; !ok)
        return std::unexpected(ok.error());
      ++next;
    }
    state->advance(time - state->now());
    state->positions(weights);
    clip.times.push_back(time);
    clip.weights.insert(clip.weights.end(), weights.begin(), weights.end());
  }
  return clip;
}

}  // namespace sweepface
