#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/regional_motion.hpp"

namespace sweepface {

/// At a time, some weights set out for new goals.
struct TimelineEvent {
  double time = 0;                                    ///< seconds
  std::vector<std::pair<std::string, double>> goals;  ///< weights by name
  bool others = false;                                ///< all other weights go to 0
  std::string region;                                 ///< only there; empty: everywhere
  Drive drive;
};

/// What an animator writes down: events in the order of their times, from 0 to `seconds`.
struct Timeline {
  double seconds = 0;  ///< how long it lasts
  int loops = 1;       ///< how often it is played, each time from where the last one left off
  std::vector<TimelineEvent> events;
};

/// Whether a JSON text is of a timeline, not of a capture: an object that has "events". Of the
/// library that converts.
bool isTimeline(std::string_view text);

/// A timeline in its JSON form (docs/clips.md). Of the same library.
Result<Timeline> parseTimeline(std::string_view text, std::string_view name);

/// Fails where an event is for a region that is not among these.
Result<void> checkRegions(const Timeline& timeline, std::span<const std::string> regions);

/// The timeline as a clip of `framesPerSecond`, from rest at 0: both ends included. Refuses events
/// out of order, matters that check() refuses and more than kMostClipWeights, in its frames or for
/// all its events to send off.
Result<Clip> bake(const Timeline& timeline, double framesPerSecond);
/// The same in one region: without what is meant for others, and by its own matter.
Result<Clip> bake(const Timeline& timeline, double framesPerSecond, std::string_view region,
                  const Matter& matter);

/// Until when a region has something to do: to the end, so much later as it is late, and until its
/// drives have arrived that elsewhere have by then. What swings or bounces ends with the timeline.
double endIn(const Timeline& timeline, std::string_view region, const Matter& matter);

struct Baked {
  Clip clip;
  double missed = 0;  ///< the most that straight lines between frames miss of a weight; jumps aside
};
/// The same to be played: 240 frames a second, and where something swings or bounces quickly so
/// many more that straight lines between them are within 1e-4 of what is meant, as far as four
/// million weights more and `regions` such clips within kMostClipWeights allow; none more where a
/// million events set out. A jump takes a 1024th of a frame. It goes on until `end`, if that is
/// later than its own: regions that are played together end together.
Result<Baked> bakeToPlay(const Timeline& timeline, std::string_view region, const Matter& matter,
                         std::size_t regions = 1, double end = 0);

}  // namespace sweepface
