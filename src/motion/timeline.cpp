#include "sweepface/timeline.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {
namespace {

std::size_t indexOf(const std::vector<std::string>& names, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

Result<void> play(const TimelineEvent& event, const Clip& clip, const Matter& matter,
                  MotionState& state) {
  const Drive drive = inMatter(event.drive, matter);
  std::vector<bool> named(clip.names.size(), false);
  for (const auto& [name, goal] : event.goals) {
    const std::size_t k = indexOf(clip.names, name);
    named[k] = true;
    if (auto ok = state.moveTo(k, goal, drive); !ok) return ok;
  }
  for (std::size_t k = 0; event.others && k < named.size(); ++k)
    if (!named[k])
      if (auto ok = state.moveTo(k, 0, drive); !ok) return ok;
  return {};
}

}  // namespace

Result<Clip> bake(const Timeline& timeline, double framesPerSecond) {
  return bake(timeline, framesPerSecond, {}, {});
}

Result<Clip> bake(const Timeline& timeline, double framesPerSecond, std::string_view region,
                  const Matter& matter) {
  const double frames = std::round(timeline.seconds * timeline.loops * framesPerSecond);
  if (!(framesPerSecond > 0) || !(frames >= 1 && frames <= 1e6))
    return failCall(
        "A timeline is baked into 1 to 1,000,000 frames; change its length or the rate.");
  Clip clip;
  for (const TimelineEvent& event : timeline.events)
    for (const auto& [name, goal] : event.goals)
      if (indexOf(clip.names, name) == clip.names.size()) clip.names.push_back(name);
  if ((frames + 1) * static_cast<double>(clip.names.size()) > kMostClipWeights)
    return failCall(
        "The timeline bakes into more weights than a clip can hold; shorten it, or name fewer.");
  auto state = MotionState::make(std::vector<double>(clip.names.size(), 0.0));
  if (!state) return std::unexpected(state.error());

  std::size_t next = 0;
  int loop = 0;
  std::vector<double> weights(clip.names.size());
  for (double frame = 0; frame <= frames; ++frame) {
    const double time = frame / framesPerSecond;
    // Everything that sets out until this frame does so at its own instant.
    while (loop < timeline.loops) {
      if (next == timeline.events.size()) {
        next = 0, ++loop;
        continue;
      }
      const TimelineEvent& event = timeline.events[next];
      const double start = event.time + loop * timeline.seconds;
      if (start > time) break;
      state->advance(start - state->now());
      const bool here = event.region.empty() || event.region == region;
      if (auto ok = here ? play(event, clip, matter, *state) : Result<void>{}; !ok)
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
